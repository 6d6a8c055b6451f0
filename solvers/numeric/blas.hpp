#pragma once
// The matrix products that carry the solvers' weight, from the machine's BLAS.

namespace coseg {

/// C = A^T B + keep C; A is k x m, B is k x n, C is m x n, column major with the given leading dimensions.
void multiply_transposed(int m, int n, int k, const double* a, int lda, const double* b, int ldb, double keep,
                         double* c, int ldc);
void multiply_transposed(int m, int n, int k, const float* a, int lda, const float* b, int ldb, float keep,
                         float* c, int ldc);

/// C = A B + keep C; A is m x k, B is k x n.
void multiply(int m, int n, int k, const double* a, int lda, const double* b, int ldb, double keep, double* c,
              int ldc);

/// Keeps a threaded BLAS to one thread: ranks are our parallelism, and threads of several ranks would fight
/// for the same cores.
void use_one_blas_thread();

}  // namespace coseg
