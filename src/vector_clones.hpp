#pragma once
// One binary that runs everywhere and is fast on machines with wide vectors.

/// Compiles the function for AVX2 besides the baseline; the loader picks. Both give the same bits: AVX2 alone brings no
/// fused multiply-add, and no compiler may reorder sums. For plain loops over arrays; library code with vector types of
/// its own (Eigen, BLAS) gains nothing. The function must not be a template.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define COSEG_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define COSEG_VECTOR_CLONES
#endif
