#include "solvers/numeric/blas.hpp"

#include <sys/mman.h>

#include <cstddef>
#include <new>

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

void reserve_blas_memory() {
    if (openblas_set_num_threads == nullptr) return;
    constexpr std::size_t bytes = std::size_t{128} << 20U;
    void* room = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) throw std::bad_alloc();
    munmap(room, bytes);
    const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(2, 2);
    Eigen::MatrixXd product(2, 2);
    multiply_transposed({one.data(), 2, 2, 2}, {one.data(), 2, 2, 2}, 0.0, {product.data(), 2, 2, 2});
}

void use_one_blas_thread() {
    if (openblas_set_num_threads != nullptr) openblas_set_num_threads(1);
}

}  // namespace coseg
