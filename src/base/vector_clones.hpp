#pragma once
// Macros for one binary that runs everywhere and is fast on machines with wide vectors.

/// Compiles the function for AVX2 besides the baseline; the loader chooses. Both give the same bits, because
/// AVX2 alone has no fused multiply-add, and no compiler may reorder sums. Use it for plain loops over
/// arrays. Library code with vector types of its own (Eigen, BLAS) gains nothing. The function must not be a
/// template.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define COSEG_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define COSEG_VECTOR_CLONES
#endif

/// The same for the widest vectors there are. COSEG_CHOOSES_WIDTH says whether such a choice can be made at
/// run time: the sanitizers cannot instrument it. Vectors of 512 bits come with fused multiply-adds, so that
/// bits may depend on the machine.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define COSEG_CHOOSES_WIDTH 1
#define COSEG_FOR_EVERY_WIDTH __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define COSEG_CHOOSES_WIDTH 0
#define COSEG_FOR_EVERY_WIDTH
#endif

/// Write this before a loop over a small fixed number of lanes. Otherwise gcc unrolls the loop before it
/// looks for vectors, and then finds none where a flag is gathered over the lanes.
#if defined(__GNUC__) && !defined(__clang__)
#define COSEG_LANES_LOOP _Pragma("GCC unroll 1")
#else
#define COSEG_LANES_LOOP
#endif
