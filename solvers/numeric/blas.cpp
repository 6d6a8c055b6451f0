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

void multiply_transposed(const MatrixView<const double>& A, const MatrixView<const double>& B, double keep,
                         const MatrixView<double>& C) {
    const double one = 1.0;
    dgemm_("T", "N", &C.rows, &C.columns, &A.rows, &one, A.data, &A.stride, B.data, &B.stride, &keep, C.data,
           &C.stride);
}

void multiply_transposed(const MatrixView<const float>& A, const MatrixView<const float>& B, float keep,
                         const MatrixView<float>& C) {
    const float one = 1.0F;
    sgemm_("T", "N", &C.rows, &C.columns, &A.rows, &one, A.data, &A.stride, B.data, &B.stride, &keep, C.data,
           &C.stride);
}

void multiply(const MatrixView<const double>& A, const MatrixView<const double>& B, double keep,
              const MatrixView<double>& C) {
    const double one = 1.0;
    dgemm_("N", "N", &C.rows, &C.columns, &A.columns, &one, A.data, &A.stride, B.data, &B.stride, &keep,
           C.data, &C.stride);
}

void use_one_blas_thread() {
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

}  // namespace coseg
