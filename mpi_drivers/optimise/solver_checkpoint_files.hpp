#pragma once
// Keeps the optimiser's finished tiles, or its iterate, in a state folder.

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/files/content_hash.hpp"
#include "mpi_drivers/optimise/iterate_file.hpp"
#include "mpi_drivers/process/run_state.hpp"
#include "solvers/variants/subspace_solver.hpp"
#include "src/parallel/comm.hpp"
#include "src/parallel/record_exchange.hpp"
#include "src/parallel/shared_counter.hpp"

namespace coseg {

/// A hash of all that a tile depends on: the problem, the options that steer the method, and the program.
ContentHash problem_key(const SubspaceProblem& problem, const SolveOptions& options);

/// Tiles are written in runs, DIR/solver/KEY/tiles-BEGIN-END.h5, by the rank that solved them. A later run
/// with any number of ranks reads the files that overlap its columns. Iterates (iterate_file.hpp) are written
/// there by all ranks, one generation after the other. A generation is removed when all files of the next are
/// there.
class SolverCheckpointFiles : public SolverCheckpoint {
  public:
    SolverCheckpointFiles(const Comm& comm, const RunState& state) : comm_(comm), state_(state) {}

    void open(const SubspaceProblem& problem, const SolveOptions& options, BlockRange owned) override;
    std::optional<SolvedTile> find(std::int64_t begin) override;
    void keep(const SolvedTile& tile) override;
    bool should_stop() override;
    std::optional<SolveIterate> find_iterate() override;
    CheckpointAction turn() override;
    void keep_iterate(const SolveIterate& iterate) override;
    void close(bool stopped) override;

    /// A sentence for each file that was damaged, on all ranks. Collective.
    [[nodiscard]] std::vector<std::string> warnings() const { return all_gather_records(comm_, warnings_); }
    /// The number of tiles of this rank that were found, and of those that were solved. An iterate counts as
    /// one on rank 0.
    [[nodiscard]] int found_count() const noexcept { return found_; }
    [[nodiscard]] int kept_count() const noexcept { return kept_; }

  private:
    using Clock = std::chrono::steady_clock;
    struct TileFile {
        BlockRange columns;
        std::string path;
    };
    std::optional<SolveIterate> load_iterate(const std::vector<IterateFile>& files);
    void load(const TileFile& file);
    void flush();

    const Comm& comm_;
    const RunState& state_;
    std::string folder_;
    BlockRange owned_;
    std::int64_t size_ = 0;  ///< columns of all ranks
    int generation_ = 0;     ///< of the iterate that was found or kept last
    bool has_iterate_ = false;
    std::vector<TileFile> files_;                ///< not yet read, that overlap the owned columns
    std::map<std::int64_t, SolvedTile> loaded_;  ///< by begin
    std::vector<SolvedTile> pending_;            ///< solved but not yet written, adjacent
    std::unique_ptr<SharedCounter> stop_;
    std::optional<Error> failure_;
    std::vector<std::string> warnings_;
    Clock::time_point last_write_;
    Clock::time_point last_look_;
    int features_ = 0;
    int found_ = 0;
    int kept_ = 0;
};

/// Writes adjacent tiles, columns [tiles.front().begin, tiles.back().end), into one file. Throws
/// Error(output).
void write_tiles(const std::string& path, const std::vector<SolvedTile>& tiles, int features);
/// Throws Error(input) for a damaged file.
std::vector<SolvedTile> read_tiles(const std::string& path);

}  // namespace coseg
