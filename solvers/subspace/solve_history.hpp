#pragma once
// The history of a solve for reports and charts: one row for each pass over all pairs.

#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "src/parallel/comm.hpp"
#include "src/records/solve_summary.hpp"

namespace coseg {

inline constexpr std::size_t most_history_rows = 256;

/// Appends a row. A full history first drops every second row, so that early rows become sparse and the last
/// ones stay.
void append_row(SolveHistory& history, const HistoryRow& row);

/// The common history of several problems. Objectives, bounds and pairs are added; iterations and gap are the
/// largest. A problem that has ended stays at its last row.
SolveHistory joined(const std::vector<SolveHistory>& histories);

/// The state of a column, or of a set of columns, after one more pass.
struct ColumnRound {
    double reached = 0.0;  ///< objective, or decrease of it
    double bound = 0.0;    ///< the best that is possible, in the same terms
    int iterations = 0;
    std::int64_t working_pairs = 0;

    bool operator==(const ColumnRound&) const = default;
    static constexpr auto fields() {
        return std::tuple(field("reached", &ColumnRound::reached), field("bound", &ColumnRound::bound),
                          field("iterations", &ColumnRound::iterations),
                          field("working_pairs", &ColumnRound::working_pairs));
    }
};

/// Appends a round. From most_history_rows on the last one is replaced.
void append_round(std::vector<ColumnRound>& rounds, const ColumnRound& round);

/// Round k of all `columns` together: sums, and the largest number of iterations. A column that has ended
/// stays at its last round; one without any round adds nothing.
std::vector<ColumnRound> joined_rounds(const std::vector<std::vector<ColumnRound>>& columns);

/// The same over the tiles of all ranks, with the same bits on any number of ranks. Collective.
std::vector<ColumnRound> joined_rounds(const Comm& comm, const std::vector<std::vector<ColumnRound>>& tiles);

}  // namespace coseg
