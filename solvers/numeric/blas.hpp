#pragma once
// The matrix products that take most of the solvers' time, from the machine's BLAS.

#include <Eigen/Core>

namespace coseg {

/// A matrix where it lies: column major, column j begins at data + j * stride.
template <class T>
struct MatrixView {
    T* data;
    int rows;
    int columns;
    int stride;
};

/// All of a matrix.
inline MatrixView<const float> whole(const Eigen::MatrixXf& matrix) {
    const auto rows = static_cast<int>(matrix.rows());
    return {matrix.data(), rows, static_cast<int>(matrix.cols()), rows};
}
inline MatrixView<float> whole(Eigen::MatrixXf& matrix) {
    const auto rows = static_cast<int>(matrix.rows());
    return {matrix.data(), rows, static_cast<int>(matrix.cols()), rows};
}

/// C = A^T B + keep C.
void multiply_transposed(const MatrixView<const double>& A, const MatrixView<const double>& B, double keep,
                         const MatrixView<double>& C);
void multiply_transposed(const MatrixView<const float>& A, const MatrixView<const float>& B, float keep,
                         const MatrixView<float>& C);

/// C = A B + keep C.
void multiply(const MatrixView<const double>& A, const MatrixView<const double>& B, double keep,
              const MatrixView<double>& C);

/// Keeps a threaded BLAS to one thread. Ranks are our parallelism, and threads of several ranks would compete
/// for the same cores.
void use_one_blas_thread();

/// Makes the BLAS take the memory that its products need. OpenBLAS takes it at the first product, and where
/// the system has none it tries again for ever. Throws std::bad_alloc where there is no room for 128 MB of
/// address space, as much as Debian's OpenBLAS takes. Does nothing with another BLAS.
void reserve_blas_memory();

}  // namespace coseg
