#pragma once

/// Compiles a function for several instruction sets and picks the best at run time. Results do not
/// differ, because nothing is contracted. Off under AddressSanitizer, which is not ready when the
/// choice is made.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define GNOMON_WIDEST_VECTORS [[gnu::target_clones("default", "avx2", "arch=x86-64-v4")]]
#else
#define GNOMON_WIDEST_VECTORS
#endif
