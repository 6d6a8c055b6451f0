#include "solvers/spectral/exact_vectors.hpp"

// PETSc and SLEPc take other operations of a vector and of a basis through their tables of functions, and
// these are declared for those who implement types, in the following two headers alone.
#include <petsc/private/vecimpl.h>
#include <slepc/private/bvimpl.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <vector>

#include "solvers/affinity/sparse_rows.hpp"
#include "solvers/spectral/tile_kernels.hpp"
#include "src/base/index.hpp"
#include "src/base/seeded_random.hpp"
#include "src/parallel/block_range.hpp"
#include "src/parallel/exact_sum.hpp"

namespace coseg {

namespace {

constexpr const char* basis_type = "coseg_exact";

/// The entries of vectors for reading, given back at the end of its life.
class ReadArrays {
  public:
    ReadArrays(std::span<const Vec> vectors) : vectors_(vectors), arrays_(vectors.size(), nullptr) {
        for (std::size_t j = 0; j < vectors.size() && code_ == 0; ++j)
            code_ = VecGetArrayRead(vectors[j], &arrays_[j]);
    }
    ~ReadArrays() {
        for (std::size_t j = 0; j < vectors_.size(); ++j) {
            if (arrays_[j] != nullptr) VecRestoreArrayRead(vectors_[j], &arrays_[j]);
        }
    }
    ReadArrays(const ReadArrays&) = delete;
    ReadArrays& operator=(const ReadArrays&) = delete;
    [[nodiscard]] PetscErrorCode code() const noexcept { return code_; }
    [[nodiscard]] const std::vector<const PetscScalar*>& arrays() const noexcept { return arrays_; }

  private:
    std::span<const Vec> vectors_;
    std::vector<const PetscScalar*> arrays_;
    PetscErrorCode code_ = 0;
};

/// The entries of a vector for writing.
class WriteArray {
  public:
    explicit WriteArray(Vec vector) : vector_(vector) { code_ = VecGetArray(vector, &array_); }
    ~WriteArray() {
        if (code_ == 0) VecRestoreArray(vector_, &array_);
    }
    WriteArray(const WriteArray&) = delete;
    WriteArray& operator=(const WriteArray&) = delete;
    [[nodiscard]] PetscErrorCode code() const noexcept { return code_; }
    [[nodiscard]] PetscScalar* get() const noexcept { return array_; }

  private:
    Vec vector_;
    PetscScalar* array_ = nullptr;
    PetscErrorCode code_ = 0;
};

PetscErrorCode reduced(MPI_Comm comm, ExactSum& sums, PetscScalar* results) {
    sums.reduce(comm);
    if (sums.overflowed()) return PETSC_ERR_FP;
    std::copy(sums.scalars().begin(), sums.scalars().end(), results);
    return 0;
}

PetscErrorCode exact_products(Vec x, PetscInt count, const Vec* y, PetscScalar* results) {
    ExactSum sums = ExactSum::of_order_one(at(count));
    {
        const ReadArrays of_x({&x, 1});
        const ReadArrays of_y({y, at(count)});
        if (of_x.code() != 0 || of_y.code() != 0) return PETSC_ERR_ARG_WRONGSTATE;
        add_products(of_y.arrays(), of_x.arrays().front(), x->map->n, sums);
    }
    return reduced(PetscObjectComm(reinterpret_cast<PetscObject>(x)), sums, results);
}

PetscErrorCode exact_product(Vec x, Vec y, PetscScalar* result) { return exact_products(x, 1, &y, result); }

PetscErrorCode exact_norm(Vec x, NormType type, PetscReal* result) {
    if (type != NORM_2 && type != NORM_FROBENIUS) return PETSC_ERR_SUP;
    PetscScalar square = 0.0;
    const PetscErrorCode code = exact_product(x, x, &square);
    *result = std::sqrt(square);
    return code;
}

/// A sum over ranks that PETSc would form itself, from what each rank gives.
PetscErrorCode refuse_local_product(Vec /*x*/, Vec /*y*/, PetscScalar* /*result*/) { return PETSC_ERR_SUP; }
PetscErrorCode refuse_local_products(Vec /*x*/, PetscInt /*count*/, const Vec* /*y*/,
                                     PetscScalar* /*result*/) {
    return PETSC_ERR_SUP;
}
PetscErrorCode refuse_local_norm(Vec /*x*/, NormType /*type*/, PetscReal* /*result*/) {
    return PETSC_ERR_SUP;
}

/// y += sum_j weights_j x_j
PetscErrorCode multiply_add(Vec y, PetscInt count, const PetscScalar* weights, Vec* x) {
    const ReadArrays of_x({x, at(count)});
    const WriteArray of_y(y);
    if (of_x.code() != 0 || of_y.code() != 0) return PETSC_ERR_ARG_WRONGSTATE;
    add_multiples(of_x.arrays(), weights, of_y.get(), y->map->n);
    return 0;
}

PetscErrorCode add_multiple(Vec y, PetscScalar weight, Vec x) { return multiply_add(y, 1, &weight, &x); }

/// y = x + weight y
PetscErrorCode add_to_multiple(Vec y, PetscScalar weight, Vec x) {
    const PetscErrorCode code = VecScale(y, weight);
    return code != 0 ? code : add_multiple(y, 1.0, x);
}

/// y = a x + b y
PetscErrorCode add_multiples_of_both(Vec y, PetscScalar a, PetscScalar b, Vec x) {
    const PetscErrorCode code = VecScale(y, b);
    return code != 0 ? code : add_multiple(y, a, x);
}

/// z = a x + b y + c z
// NOLINTNEXTLINE(readability-function-size): PETSc prescribes the parameters
PetscErrorCode add_multiples_of_three(Vec z, PetscScalar a, PetscScalar b, PetscScalar c, Vec x, Vec y) {
    const PetscErrorCode code = add_multiples_of_both(z, a, c, x);
    return code != 0 ? code : add_multiple(z, b, y);
}

/// w = y + weight x
PetscErrorCode write_sum(Vec w, PetscScalar weight, Vec x, Vec y) {
    const PetscErrorCode code = VecCopy(y, w);
    return code != 0 ? code : add_multiple(w, weight, x);
}

/// The first rank draws one number of the generator, whatever its share of the rows is.
PetscErrorCode fill_randomly(Vec x, PetscRandom random) {
    PetscReal drawn = 0.0;
    const PetscErrorCode code = PetscRandomGetValueReal(random, &drawn);
    if (code != 0) return code;
    MPI_Bcast(&drawn, 1, MPI_DOUBLE, 0, PetscObjectComm(reinterpret_cast<PetscObject>(x)));
    std::uint64_t bits = 0;
    std::memcpy(&bits, &drawn, sizeof(bits));
    const WriteArray values(x);
    if (values.code() != 0) return values.code();
    for (PetscInt i = 0; i < x->map->n; ++i) {
        const auto row = static_cast<std::uint64_t>(x->map->rstart + i);
        values.get()[i] = 1.0 - 2.0 * uniform_of(hash_words({bits, row}));
    }
    return 0;
}

void set_operations(_VecOps& operations) {
    operations.dot = operations.tdot = exact_product;
    operations.mdot = operations.mtdot = exact_products;
    operations.norm = exact_norm;
    operations.dot_local = operations.tdot_local = refuse_local_product;
    operations.mdot_local = operations.mtdot_local = refuse_local_products;
    operations.norm_local = refuse_local_norm;
    operations.dotnorm2 = nullptr;  // PETSc then takes two products
    operations.axpy = add_multiple;
    operations.aypx = add_to_multiple;
    operations.axpby = add_multiples_of_both;
    operations.axpbypcz = add_multiples_of_three;
    operations.waxpy = write_sum;
    operations.maxpy = multiply_add;
    operations.setrandom = fill_randomly;
}

/// V(:, first .. end-1) = V(:, active columns) Q(active rows, first .. end-1)
PetscErrorCode combine_in_place(BV basis, Mat q, PetscInt first, PetscInt end) {
    const PetscScalar* values = nullptr;
    PetscInt stride = 0;
    PetscErrorCode code = MatDenseGetLDA(q, &stride);
    if (code == 0) code = MatDenseGetArrayRead(q, &values);
    std::vector<double*> columns;  // entries stay where they are while their vector is not taken
    for (PetscInt j = basis->l; j < basis->k && code == 0; ++j) {
        Vec column = nullptr;
        code = BVGetColumn(basis, j, &column);
        if (code != 0) break;
        columns.push_back(WriteArray(column).get());
        code = BVRestoreColumn(basis, j, &column);
    }
    if (code != 0) return code;
    const std::span<double* const> results =
        std::span(columns).subspan(at(first - basis->l), at(end - first));
    combine_columns(std::vector<const double*>(columns.begin(), columns.end()),
                    {values + basis->l + static_cast<std::int64_t>(first) * stride, stride}, results,
                    basis->n);
    return MatDenseRestoreArrayRead(q, &values);
}

/// An array of vectors whose own operations suffice, but for the combination in place: SLEPc's would call
/// BLAS on blocks of the rank's rows.
PetscErrorCode create_exact_basis(BV basis) {
    PetscErrorCode (*create_vectors)(BV) = nullptr;
    PetscErrorCode code = PetscFunctionListFind(BVList, BVVECS, &create_vectors);
    if (code == 0 && create_vectors == nullptr) code = PETSC_ERR_LIB;
    if (code == 0) code = create_vectors(basis);
    if (code != 0) return code;
    basis->ops->multinplace = combine_in_place;
    basis->ops->multinplacetrans = nullptr;
    basis->ops->setfromoptions = nullptr;  // these two would set SLEPc's combination again
    basis->ops->duplicate = nullptr;
    return 0;
}

}  // namespace

PetscVector row_vector(const Comm& comm, std::int64_t size, VectorSums sums) {
    const BlockRange rows = block_range(size, comm.size(), comm.rank(), row_tile);
    PetscVector vector;
    check(VecCreateMPI(comm.raw(), petsc_int(rows.size(), "rows"), petsc_int(size, "patches"), vector.out()),
          "VecCreateMPI");
    if (sums == VectorSums::exact) set_operations(*vector.get()->ops);
    return vector;
}

PetscVector exact_vector(const Comm& comm, std::int64_t size) {
    return row_vector(comm, size, VectorSums::exact);
}

BasisVectors exact_basis(const Comm& comm, const PetscVector& like, int columns) {
    check(BVRegister(basis_type, create_exact_basis), "BVRegister");
    BasisVectors basis;
    check(BVCreate(comm.raw(), basis.out()), "BVCreate");
    check(BVSetSizesFromVec(basis.get(), like.get(), columns), "BVSetSizesFromVec");
    check(BVSetType(basis.get(), basis_type), "BVSetType");
    check(BVSetMatMultMethod(basis.get(), BV_MATMULT_VECS), "BVSetMatMultMethod");
    return basis;
}

}  // namespace coseg
