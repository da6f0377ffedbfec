// SPDX-License-Identifier: MIT
// A target of CMake has a source; this one has headers to precompile.
