#include "solvers/spectral/served_product.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr double product_wanted = 1.0;
constexpr double no_more = 0.0;

PetscErrorCode multiply_shell(Mat matrix, Vec x, Vec y) {
    void* product = nullptr;
    const PetscScalar* from = nullptr;
    PetscScalar* to = nullptr;
    PetscErrorCode code = MatShellGetContext(matrix, static_cast<void*>(&product));
    if (code == 0) code = VecGetArrayRead(x, &from);
    if (code == 0) code = VecGetArray(y, &to);
    if (code != 0) return code;
    static_cast<ServedProduct*>(product)->multiply(from, to);
    code = VecRestoreArray(y, &to);
    return code != 0 ? code : VecRestoreArrayRead(x, &from);
}

}  // namespace

ServedProduct::ServedProduct(const Comm& comm, const SparseRows& matrix, GroupBalance balance)
    : comm_(comm), matrix_(matrix), balance_(std::move(balance)), message_(at(matrix.size) + 1, no_more) {
    if (balance_.weight != 0.0 && !balance_.group.empty()) {
        const int last = *std::max_element(balance_.group.begin(), balance_.group.end());
        group_sums_.resize(at(last) + 1);
    }
    rows_local_.resize(at(matrix.local_rows()));
    for (int rank = 0; rank < comm.size(); ++rank) {
        const BlockRange rows = block_range(matrix.size, comm.size(), rank, row_tile);
        counts_.push_back(static_cast<int>(rows.size()));
        offsets_.push_back(static_cast<int>(rows.begin));
    }
}

/// Adds the row's products from entry `skip` of the row on.
double ServedProduct::add_products(std::size_t row, std::int64_t skip, double sum) const {
    for (auto k = at(matrix_.offsets[row] + skip); k < at(matrix_.offsets[row + 1]); ++k) {
        sum += matrix_.values[k] * message_[at(matrix_.columns[k])];
    }
    return sum;
}

/// Side by side as far as the shortest of the rows goes: one sum's additions wait for each other.
void ServedProduct::multiply_four_rows(std::size_t first) {
    std::array<const double*, 4> values{};
    std::array<const int*, 4> columns{};
    std::array<double, 4> sums{};
    std::int64_t shared = matrix_.size;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const std::int64_t begin = matrix_.offsets[first + i];
        values[i] = matrix_.values.data() + begin;
        columns[i] = matrix_.columns.data() + begin;
        shared = std::min(shared, matrix_.offsets[first + i + 1] - begin);
    }
    for (std::int64_t k = 0; k < shared; ++k) {
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += values[i][k] * message_[at(columns[i][k])];
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        rows_local_[first + i] = add_products(first + i, shared, sums[i]);
}

void ServedProduct::multiply_rows() {
    const std::size_t whole = rows_local_.size() - rows_local_.size() % 4;
    for (std::size_t r = 0; r < whole; r += 4) multiply_four_rows(r);
    for (std::size_t r = whole; r < rows_local_.size(); ++r) rows_local_[r] = add_products(r, 0, 0.0);
}

void ServedProduct::subtract_balance(const double* x, double* y) {
    if (group_sums_.empty()) return;
    std::fill(group_sums_.begin(), group_sums_.end(), 0.0);
    for (std::size_t i = 0; i < balance_.group.size(); ++i)
        group_sums_[at(balance_.group[i])] += balance_.indicator[i] * x[i];
    for (std::size_t i = 0; i < balance_.group.size(); ++i)
        y[i] -= balance_.weight * balance_.indicator[i] * group_sums_[at(balance_.group[i])];
}

void ServedProduct::multiply(const double* x, double* y) {
    std::copy_n(x, matrix_.size, message_.begin());
    message_.back() = product_wanted;
    if (comm_.size() > 1)
        MPI_Bcast(message_.data(), static_cast<int>(message_.size()), MPI_DOUBLE, 0, comm_.raw());
    multiply_rows();
    if (comm_.size() == 1) {
        std::copy(rows_local_.begin(), rows_local_.end(), y);
    } else {
        MPI_Gatherv(rows_local_.data(), counts_.front(), MPI_DOUBLE, y, counts_.data(), offsets_.data(),
                    MPI_DOUBLE, 0, comm_.raw());
    }
    subtract_balance(x, y);
}

void ServedProduct::serve() {
    while (true) {
        MPI_Bcast(message_.data(), static_cast<int>(message_.size()), MPI_DOUBLE, 0, comm_.raw());
        if (message_.back() == no_more) return;
        multiply_rows();
        MPI_Gatherv(rows_local_.data(), static_cast<int>(rows_local_.size()), MPI_DOUBLE, nullptr, nullptr,
                    nullptr, MPI_DOUBLE, 0, comm_.raw());
    }
}

void ServedProduct::release() {
    message_.back() = no_more;
    if (comm_.size() > 1)
        MPI_Bcast(message_.data(), static_cast<int>(message_.size()), MPI_DOUBLE, 0, comm_.raw());
}

PetscMatrix shell_matrix(ServedProduct& product) {
    const PetscInt size = petsc_int(product.size(), "patches");
    PetscMatrix result;
    check(MatCreateShell(PETSC_COMM_SELF, size, size, size, size, &product, result.out()), "MatCreateShell");
    check(MatShellSetOperation(result.get(), MATOP_MULT, reinterpret_cast<void (*)()>(multiply_shell)),
          "MatShellSetOperation");
    check(MatSetOption(result.get(), MAT_SYMMETRIC, PETSC_TRUE), "MatSetOption");
    return result;
}

}  // namespace coseg
