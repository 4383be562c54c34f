#pragma once

/// Compiles a function for several instruction sets and takes the best at run time; results are the
/// same, as nothing is contracted. The choice is made before AddressSanitizer is ready.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define GNOMON_WIDEST_VECTORS [[gnu::target_clones("default", "avx2", "arch=x86-64-v4")]]
#else
#define GNOMON_WIDEST_VECTORS
#endif
