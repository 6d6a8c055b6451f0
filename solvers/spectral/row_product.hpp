#pragma once
// Products of a sparse symmetric matrix with distributed vectors.

#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/petsc/petsc_handle.hpp"
#include "solvers/spectral/sliced_rows.hpp"
#include "solvers/spectral/vector_sums.hpp"
#include "src/parallel/comm.hpp"

namespace coseg {

/// What is subtracted from a product: weight Q Q^T x, where the one nonzero of row i of Q is indicator[i], in
/// column group[i]. Q Q^T is not formed: it would have an entry for every two patches of a mesh, more than
/// the affinity itself.
struct GroupBalance {
    double weight = 0.0;            ///< 0: nothing is subtracted
    std::vector<int> group;         ///< of all rows, the same on all ranks
    std::vector<double> indicator;  ///< likewise
};

/// The matrix less the balance, as an operator of PETSc. A rank keeps its rows, and of a vector those entries
/// that its rows and its groups ask for; before a product it is sent what it lacks of them. The product of a
/// row is summed in the order of the columns, and Q^T x of a group in the order of the rows, so that results
/// have the same bits on any number of ranks.
class RowProduct {
  public:
    /// Rows owned as SparseRows says; their columns are numbered anew inside. Collective. Throws
    /// Error(internal).
    RowProduct(const Comm& comm, SparseRows matrix, const GroupBalance& balance = {},
               VectorSums sums = VectorSums::exact, EntryPrecision precision = EntryPrecision::full);
    RowProduct(const RowProduct&) = delete;
    RowProduct& operator=(const RowProduct&) = delete;
    ~RowProduct() = default;

    /// As an operator, which this must outlive; its vectors are those of row_vector.
    [[nodiscard]] Mat matrix() const noexcept { return shell_.get(); }
    /// All 0; solvers duplicate it. Collective where it is duplicated.
    [[nodiscard]] const PetscVector& vector() const noexcept { return vector_; }
    [[nodiscard]] std::int64_t size() const noexcept { return size_; }
    /// Of its vectors.
    [[nodiscard]] VectorSums sums() const noexcept { return sums_; }
    /// The products so far.
    [[nodiscard]] std::int64_t count() const noexcept { return count_; }

    /// What PETSc calls; collective.
    PetscErrorCode multiply(Vec x, Vec y);

  private:
    void number_columns(const Comm& comm, const GroupBalance& balance, SparseRows& matrix);
    void number_groups(const GroupBalance& balance, BlockRange own, const std::vector<int>& place_of_row);
    void subtract_balance(const double* x, double* y);

    /// A row of a group: where x has it, and its indicator.
    struct GroupRow {
        int place = 0;
        double indicator = 0.0;
    };
    /// The groups that a row of this rank belongs to.
    struct Groups {
        double weight = 0.0;
        std::vector<std::size_t> offsets = {0};  ///< group g has the rows offsets[g] .. offsets[g + 1]
        std::vector<GroupRow> rows;              ///< ascending in each group
        std::vector<int> of_row;                 ///< of this rank's rows
        std::vector<double> indicator;           ///< likewise
        std::vector<double> sums;                ///< Q^T x
    };

    std::int64_t size_ = 0;
    VectorSums sums_;
    SlicedRows rows_;
    Groups groups_;
    PetscVector vector_;
    PetscVector needed_;  ///< the entries of x that this rank asks for, ascending; none on one rank
    PetscHandle<VecScatter, VecScatterDestroy> scatter_;
    PetscMatrix shell_;
    std::int64_t count_ = 0;
};

}  // namespace coseg
