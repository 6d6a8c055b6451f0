#pragma once
// Products of a matrix that is spread over the ranks, for a serial method that runs on the root.

#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/petsc/petsc_handle.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What is subtracted from a product: weight Q Q^T x, where the one nonzero of row i of Q is indicator[i], in
/// column group[i]. Q Q^T is not formed: it would have an entry for every two patches of a mesh, more than
/// the affinity itself.
struct GroupBalance {
    double weight = 0.0;  ///< 0: nothing is subtracted
    std::vector<int> group;
    std::vector<double> indicator;
};

/// The root multiplies; the other ranks serve their rows until they are released. A row's product is summed
/// in the order of its columns by the rank that holds it, and everything else is the root's, so that results
/// have the same bits on any number of ranks. A product takes a broadcast and a gathering of N doubles.
class ServedProduct {
  public:
    /// `matrix` must outlive this, rows owned as SparseRows says; the root alone looks at `balance`.
    /// Collective.
    ServedProduct(const Comm& comm, const SparseRows& matrix, GroupBalance balance = {});

    /// y = A x less the balance, N doubles each. On the root, while the others serve.
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
    void multiply_four_rows(std::size_t first);
    [[nodiscard]] double add_products(std::size_t row, std::int64_t skip, double sum) const;
    void subtract_balance(const double* x, double* y);

    const Comm& comm_;
    const SparseRows& matrix_;
    GroupBalance balance_;
    std::vector<double> group_sums_;  ///< Q^T x
    std::vector<double> message_;     ///< x, and whether there is one
    std::vector<double> rows_local_;  ///< y of the owned rows
    std::vector<int> counts_;         ///< rows of each rank
    std::vector<int> offsets_;
};

/// As PETSc's serial methods take it; the product must outlive it. Throws Error(internal).
PetscMatrix shell_matrix(ServedProduct& product);

}  // namespace coseg
