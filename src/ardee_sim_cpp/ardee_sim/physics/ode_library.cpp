// SPDX-License-Identifier: MIT
#include "ardee_sim/physics/ode_library.h"

#include <ode/ode.h>

#include <array>
#include <cstdarg>
#include <cstdio>
#include <mutex>
#include <string>
#include <utility>

namespace ardee::physics {
namespace {

std::mutex holders_mutex;
int holders = 0;
thread_local bool complained = false;

// ODE ends the process if this handler returns.
[[noreturn]] void on_failure(int, const char* format, va_list arguments) {
  std::array<char, 256> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  throw EngineFault(std::string("physics engine: ") + text.data());
}

// The solver's only messages report a singular system.
void on_message(int, const char*, va_list) { complained = true; }

}  // namespace

OdeLibrary::OdeLibrary() {
  const std::lock_guard<std::mutex> lock(holders_mutex);
  if (holders == 0) {
    if (!dInitODE2(0)) throw Error("physics engine: cannot initialise");
    dSetErrorHandler(on_failure);
    dSetDebugHandler(on_failure);
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

bool OdeLibrary::take_singular_warning() { return std::exchange(complained, false); }

}  // namespace ardee::physics
