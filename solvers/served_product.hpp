#pragma once
// Products of a matrix that is spread over the ranks, for a serial method that runs on the root.

#include <vector>

#include "solvers/petsc_handle.hpp"
#include "solvers/sparse_rows.hpp"
#include "src/comm.hpp"

namespace coseg {

/// The root multiplies; the other ranks serve their rows until they are released. A row's product is summed in the order
/// of its columns by the rank that holds it, and everything else is the root's, so that results have the same bits on any
/// number of ranks. A product takes a broadcast and a gathering of N doubles.
class ServedProduct {
  public:
    /// `matrix` must outlive this, rows owned as SparseRows says. Collective.
    ServedProduct(const Comm& comm, const SparseRows& matrix);

    /// y = A x, N doubles each. On the root, while the others serve.
    void multiply(const double* x, double* y);
    /// On the other ranks: returns once the root lets go.
    void serve();

    /// On the root: lets the others go when it goes out of scope.
    class Release {
      public:
        explicit Release(ServedProduct& product) : product_(product) {}
        ~Release() { product_.release(); }
        Release(const Release&) = delete;
        Release& operator=(const Release&) = delete;

      private:
        ServedProduct& product_;
    };

    [[nodiscard]] std::int64_t size() const noexcept { return matrix_.size; }

  private:
    void release();
    void multiply_rows();

    const Comm& comm_;
    const SparseRows& matrix_;
    std::vector<double> message_;     ///< x, and whether there is one
    std::vector<double> rows_local_;  ///< y of the owned rows
    std::vector<int> counts_;         ///< rows of each rank
    std::vector<int> offsets_;
};

/// As PETSc's serial methods take it; the product must outlive it. Throws Error(internal).
PetscMatrix shell_matrix(ServedProduct& product);

}  // namespace coseg
