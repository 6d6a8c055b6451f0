#include "solvers/numeric/blas.hpp"

extern "C" {
// NOLINTBEGIN(readability-identifier-naming): the names are those of the BLAS
void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
            const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
            const double* beta, double* c, const int* ldc);
void sgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
            const float* alpha, const float* a, const int* lda, const float* b, const int* ldb,
            const float* beta, float* c, const int* ldc);
// NOLINTEND(readability-identifier-naming)
// Absent from other BLAS libraries, hence weak.
void openblas_set_num_threads(int threads) __attribute__((weak));
}

namespace coseg {

void multiply_transposed(int m, int n, int k, const double* a, int lda, const double* b, int ldb, double keep,
                         double* c, int ldc) {
    const double one = 1.0;
    dgemm_("T", "N", &m, &n, &k, &one, a, &lda, b, &ldb, &keep, c, &ldc);
}

void multiply_transposed(int m, int n, int k, const float* a, int lda, const float* b, int ldb, float keep,
                         float* c, int ldc) {
    const float one = 1.0F;
    sgemm_("T", "N", &m, &n, &k, &one, a, &lda, b, &ldb, &keep, c, &ldc);
}

void multiply(int m, int n, int k, const double* a, int lda, const double* b, int ldb, double keep, double* c,
              int ldc) {
    const double one = 1.0;
    dgemm_("N", "N", &m, &n, &k, &one, a, &lda, b, &ldb, &keep, c, &ldc);
}

void use_one_blas_thread() {
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

}  // namespace coseg
