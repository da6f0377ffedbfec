// SPDX-License-Identifier: MIT
#pragma once

// Makes one clone of a function per vector width; the loader picks the widest that the processor
// has. Contraction is off, so each clone gives the same bits. Sanitizers cannot run before the
// loader picks a clone.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ARDEE_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ARDEE_VECTOR_CLONES
#endif
