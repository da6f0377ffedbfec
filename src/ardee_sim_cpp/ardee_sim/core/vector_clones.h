// SPDX-License-Identifier: MIT
#pragma once

// Of a function, one for each width of vectors, of which the loader takes the widest that there is.
// Contraction is off, so each clone gives the same bits. Sanitizers cannot run before the loader
// picks a clone.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define ARDEE_VECTOR_CLONES __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define ARDEE_VECTOR_CLONES
#endif
