// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/ode_library.h"

#include <ode/ode.h>

#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <string>
#include <utility>

#include "ardee_sim/core/error.h"

namespace ardee::physics {
namespace {

std::mutex holders_mutex;
int holders = 0;
thread_local std::string reported;
thread_local bool complained = false;

void report(const char* kind, const char* format, va_list arguments) {
  char text[512];
  std::vsnprintf(text, sizeof text, format, arguments);
  if (reported.empty()) reported = std::string("physics engine ") + kind + ": " + text;
}

void on_error(int, const char* format, va_list arguments) { report("error", format, arguments); }
void on_debug(int, const char* format, va_list arguments) { report("assertion", format, arguments); }
// The solver's only messages say that it met a singular system.
void on_message(int, const char*, va_list) { complained = true; }

}  // namespace

OdeLibrary::OdeLibrary() {
  const std::lock_guard<std::mutex> lock(holders_mutex);
  if (holders == 0) {
    if (!dInitODE2(0)) throw Error("physics engine: cannot initialise");
    dSetErrorHandler(on_error);
    dSetDebugHandler(on_debug);
    dSetMessageHandler(on_message);
  }
  ++holders;
  prepare_thread();
}

OdeLibrary::~OdeLibrary() {
  const std::lock_guard<std::mutex> lock(holders_mutex);
  if (--holders == 0) dCloseODE();
}

void OdeLibrary::prepare_thread() { dAllocateODEDataForThread(dAllocateMaskAll); }

bool OdeLibrary::take_complaint() { return std::exchange(complained, false); }

void OdeLibrary::throw_reported() {
  if (reported.empty()) return;
  std::string text;
  text.swap(reported);
  throw Error(text);
}

}  // namespace ardee::physics
