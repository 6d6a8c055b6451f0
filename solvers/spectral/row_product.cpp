#include "solvers/spectral/row_product.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "solvers/spectral/exact_vectors.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

using IndexSet = PetscHandle<IS, ISDestroy>;

PetscErrorCode multiply_shell(Mat matrix, Vec x, Vec y) {
    void* product = nullptr;
    const PetscErrorCode code = MatShellGetContext(matrix, static_cast<void*>(&product));
    return code != 0 ? code : static_cast<RowProduct*>(product)->multiply(x, y);
}

PetscErrorCode create_vectors(Mat matrix, Vec* right, Vec* left) {
    void* product = nullptr;
    PetscErrorCode code = MatShellGetContext(matrix, static_cast<void*>(&product));
    Vec like = code == 0 ? static_cast<RowProduct*>(product)->vector().get() : nullptr;
    if (code == 0 && right != nullptr) code = VecDuplicate(like, right);
    if (code == 0 && left != nullptr) code = VecDuplicate(like, left);
    return code;
}

/// Whether a rank asks for an entry: its rows have it as a column, or it belongs to one of their groups.
std::vector<char> asked_rows(const SparseRows& matrix, const GroupBalance& balance) {
    std::vector<char> asked(at(matrix.size), 0);
    for (const int column : matrix.columns) asked[at(column)] = 1;
    if (balance.weight == 0.0) return asked;
    std::vector<char> own_group(at(*std::max_element(balance.group.begin(), balance.group.end())) + 1, 0);
    for (auto i = matrix.rows.begin; i < matrix.rows.end; ++i) own_group[at(balance.group[at(i)])] = 1;
    for (std::size_t i = 0; i < asked.size(); ++i) {
        if (own_group[at(balance.group[i])] != 0) asked[i] = 1;
    }
    return asked;
}

}  // namespace

RowProduct::RowProduct(const Comm& comm, SparseRows matrix, const GroupBalance& balance, VectorSums sums,
                       EntryPrecision precision)
    : size_(matrix.size), sums_(sums), vector_(row_vector(comm, size_, sums)) {
    number_columns(comm, balance, matrix);
    const PetscInt rows = petsc_int(matrix.local_rows(), "rows");
    rows_ = SlicedRows(std::move(matrix), precision);
    const PetscInt all = petsc_int(size_, "patches");
    check(MatCreateShell(comm.raw(), rows, rows, all, all, this, shell_.out()), "MatCreateShell");
    check(MatShellSetOperation(shell_.get(), MATOP_MULT, reinterpret_cast<void (*)()>(multiply_shell)),
          "MatShellSetOperation");
    check(MatShellSetOperation(shell_.get(), MATOP_CREATE_VECS, reinterpret_cast<void (*)()>(create_vectors)),
          "MatShellSetOperation");
    check(MatSetOption(shell_.get(), MAT_SYMMETRIC, PETSC_TRUE), "MatSetOption");
}

/// On one rank columns are as they are. Otherwise each becomes its place among the entries asked for, which
/// keeps the order of a row's columns.
void RowProduct::number_columns(const Comm& comm, const GroupBalance& balance, SparseRows& matrix) {
    std::vector<int> place(at(size_));
    if (comm.size() == 1) {
        std::iota(place.begin(), place.end(), 0);
    } else {
        const std::vector<char> asked = asked_rows(matrix, balance);
        std::vector<PetscInt> rows;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            place[i] = static_cast<int>(rows.size());
            if (asked[i] != 0) rows.push_back(static_cast<PetscInt>(i));
        }
        for (int& column : matrix.columns) column = place[at(column)];
        const auto count = static_cast<PetscInt>(rows.size());
        IndexSet from;
        check(VecCreateSeq(PETSC_COMM_SELF, count, needed_.out()), "VecCreateSeq");
        check(ISCreateGeneral(PETSC_COMM_SELF, count, rows.data(), PETSC_COPY_VALUES, from.out()),
              "ISCreateGeneral");
        check(VecScatterCreate(vector_.get(), from.get(), needed_.get(), nullptr, scatter_.out()),
              "VecScatterCreate");
    }
    if (balance.weight != 0.0) number_groups(balance, matrix.rows, place);
}

/// The groups of this rank's rows, numbered 0, 1, ... in the order of their names.
void RowProduct::number_groups(const GroupBalance& balance, BlockRange own,
                               const std::vector<int>& place_of_row) {
    const auto begin = at(own.begin);
    const auto end = at(own.end);
    groups_.weight = balance.weight;
    std::vector<int> names(balance.group.begin() + own.begin, balance.group.begin() + own.end);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::vector<std::vector<GroupRow>> rows(names.size());
    for (std::size_t i = 0; i < balance.group.size(); ++i) {
        const auto name = std::lower_bound(names.begin(), names.end(), balance.group[i]);
        if (name == names.end() || *name != balance.group[i]) continue;
        const auto number = name - names.begin();
        rows[at(number)].push_back({place_of_row[i], balance.indicator[i]});
        if (i < begin || i >= end) continue;
        groups_.of_row.push_back(static_cast<int>(number));
        groups_.indicator.push_back(balance.indicator[i]);
    }
    for (const std::vector<GroupRow>& group : rows) {
        groups_.rows.insert(groups_.rows.end(), group.begin(), group.end());
        groups_.offsets.push_back(groups_.rows.size());
    }
    groups_.sums.resize(names.size());
}

void RowProduct::subtract_balance(const double* x, double* y) {
    for (std::size_t g = 0; g < groups_.sums.size(); ++g) {
        groups_.sums[g] = 0.0;
        for (auto k = groups_.offsets[g]; k < groups_.offsets[g + 1]; ++k)
            groups_.sums[g] += groups_.rows[k].indicator * x[groups_.rows[k].place];
    }
    for (std::size_t i = 0; i < groups_.of_row.size(); ++i)
        y[i] -= groups_.weight * groups_.indicator[i] * groups_.sums[at(groups_.of_row[i])];
}

PetscErrorCode RowProduct::multiply(Vec x, Vec y) {
    ++count_;
    const bool is_sent = needed_.get() != nullptr;
    Vec source = is_sent ? needed_.get() : x;
    PetscErrorCode code = 0;
    if (is_sent) code = VecScatterBegin(scatter_.get(), x, source, INSERT_VALUES, SCATTER_FORWARD);
    if (is_sent && code == 0) code = VecScatterEnd(scatter_.get(), x, source, INSERT_VALUES, SCATTER_FORWARD);
    const PetscScalar* from = nullptr;
    PetscScalar* to = nullptr;
    if (code == 0) code = VecGetArrayRead(source, &from);
    if (code == 0) code = VecGetArrayWrite(y, &to);
    if (code != 0) return code;
    rows_.multiply(from, to);
    subtract_balance(from, to);
    code = VecRestoreArrayWrite(y, &to);
    return code != 0 ? code : VecRestoreArrayRead(source, &from);
}

}  // namespace coseg
