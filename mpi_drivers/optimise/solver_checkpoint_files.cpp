#include "mpi_drivers/optimise/solver_checkpoint_files.hpp"

#include <cstdio>
#include <filesystem>
#include <span>

#include "io/files/folder_entries.hpp"
#include "io/files/record_file.hpp"
#include "io/files/record_hash.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"
#include "src/parallel/record_exchange.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

constexpr const char* tiles_format = "coseg solver tiles";
constexpr int tiles_version = 3;
constexpr std::chrono::seconds look_interval{1};

std::string tiles_name(std::int64_t begin, std::int64_t end) {
    char text[64];
    std::snprintf(text, sizeof text, "tiles-%010lld-%010lld.h5", static_cast<long long>(begin),
                  static_cast<long long>(end));
    return text;
}

std::optional<BlockRange> columns_of(const std::string& name) {
    long long begin = 0;
    long long end = 0;
    if (std::sscanf(name.c_str(), "tiles-%lld-%lld.h5", &begin, &end) != 2) return std::nullopt;
    if (name != tiles_name(begin, end) || begin >= end) return std::nullopt;
    return BlockRange{begin, end};
}

}  // namespace

ContentHash problem_key(const SubspaceProblem& problem, const SolveOptions& options) {
    // One name for each field: a new one does not compile until it has been thought of here.
    const auto& [features, alpha, beta, lambda, scope, mesh_of, allowed_meshes] = problem;
    const auto& [gap, max_iterations, max_seconds, solver, progress, checkpoint, pair_scorer] = options;
    ContentHasher hasher;
    hasher.add(source_fingerprint(KeptPiece::solutions));
    hasher.add(std::int64_t{tiles_version});
    for (const double number : {alpha, beta, lambda, gap}) hasher.add(number);
    hasher.add(max_iterations);
    hasher.add(to_string(solver));
    hasher.add(static_cast<int>(scope));
    add_value(hasher, mesh_of);
    add_value(hasher, allowed_meshes);
    for (const Eigen::Index begin : features.offsets()) hasher.add(std::int64_t{begin});
    hasher.add(std::span<const double>(features.data(),
                                       static_cast<std::size_t>(features.dimension() * features.columns())));
    static_cast<void>(max_seconds);  // a tile that the clock cut short is not kept
    static_cast<void>(progress);
    static_cast<void>(checkpoint);
    static_cast<void>(pair_scorer);  // the certificate holds whoever scores
    return hasher.result();
}

void write_tiles(const std::string& path, const std::vector<SolvedTile>& tiles, int features) {
    std::size_t pairs = 0;
    for (const SolvedTile& tile : tiles) pairs += tile.rows.size();
    Hdf5Writer file(path, tiles_format, tiles_version);
    file.attribute("features", std::int64_t{features});
    file.attribute("source_fingerprint", source_fingerprint(KeptPiece::solutions));
    file.summary("solver, columns " + std::to_string(tiles.front().begin) + " to " +
                 std::to_string(tiles.back().end) + ", " + std::to_string(pairs) + " pairs");
    write_column(file, "tiles", tiles);
    file.commit();
}

std::vector<SolvedTile> read_tiles(const std::string& path) {
    return read_column<SolvedTile>(Hdf5Reader(path, tiles_format, tiles_version), "tiles");
}

void SolverCheckpointFiles::open(const SubspaceProblem& problem, const SolveOptions& options,
                                 BlockRange owned) {
    features_ = problem.feature_count();
    owned_ = owned;
    size_ = problem.size();
    generation_ = 0;
    has_iterate_ = false;
    folder_ = state_.folder().solver_folder(problem_key(problem, options));
    agree(comm_, [&] {
        if (comm_.is_root()) make_parent_folders(folder_ + "/tiles");
    });
    files_.clear();
    loaded_.clear();
    pending_.clear();
    std::error_code ignored;
    for (const fs::path& path : folder_entries(folder_, ignored)) {
        const std::optional<BlockRange> columns = columns_of(path.filename().string());
        if (columns && columns->begin < owned.end && columns->end > owned.begin)
            files_.push_back({*columns, path.string()});
    }
    stop_ = std::make_unique<SharedCounter>(comm_);
    last_write_ = last_look_ = Clock::now();
}

void SolverCheckpointFiles::load(const TileFile& file) {
    try {
        for (SolvedTile& tile : read_tiles(file.path)) {
            const std::int64_t begin = tile.begin;
            loaded_.insert_or_assign(begin, std::move(tile));
        }
        mark_as_used(file.path);
    } catch (const Error& error) {
        const std::string aside = state_.folder().set_aside(file.path);
        warnings_.push_back(std::string(error.what()) + "; it is set aside as " + aside +
                            " and its columns are solved anew");
    }
}

std::optional<SolvedTile> SolverCheckpointFiles::find(std::int64_t begin) {
    loaded_.erase(loaded_.begin(), loaded_.lower_bound(begin));
    while (!files_.empty() && files_.front().columns.begin <= begin) {
        if (files_.front().columns.end > begin) load(files_.front());
        files_.erase(files_.begin());
    }
    loaded_.erase(loaded_.begin(), loaded_.lower_bound(begin));
    const auto found = loaded_.find(begin);
    if (found == loaded_.end()) return std::nullopt;
    ++found_;
    return std::move(found->second);
}

void SolverCheckpointFiles::keep(const SolvedTile& tile) {
    ++kept_;
    try {
        if (!pending_.empty() && pending_.back().end != tile.begin) flush();
        pending_.push_back(tile);
        const std::chrono::duration<double> since = Clock::now() - last_write_;
        if (since.count() >= state_.checkpoint_seconds()) flush();
    } catch (const Error& error) {
        failure_ = error;
    }
}

void SolverCheckpointFiles::flush() {
    last_write_ = Clock::now();
    if (pending_.empty()) return;
    write_tiles(folder_ + "/" + tiles_name(pending_.front().begin, pending_.back().end), pending_, features_);
    pending_.clear();
}

bool SolverCheckpointFiles::should_stop() {
    if (state_.stop_is_raised() || failure_) {
        stop_->exhaust();
        return true;
    }
    const Clock::time_point now = Clock::now();
    if (now - last_look_ < look_interval) return false;
    last_look_ = now;
    return stop_->is_exhausted();
}

/// This rank's columns of one generation, from the files that hold them; nothing if one of these is damaged.
std::optional<SolveIterate> SolverCheckpointFiles::load_iterate(const std::vector<IterateFile>& files) {
    std::vector<SolveIterate> parts;
    for (const IterateFile& file : files) {
        const bool overlaps = file.columns.begin < owned_.end && file.columns.end > owned_.begin;
        const bool only_numbers = owned_.size() == 0 && parts.empty();
        if (!overlaps && !only_numbers) continue;
        try {
            parts.push_back(read_iterate(file.path));
            mark_as_used(file.path);
        } catch (const Error& error) {
            warnings_.push_back(std::string(error.what()) + "; it is set aside as " +
                                state_.folder().set_aside(file.path) +
                                " and the optimiser continues from an earlier point");
            return std::nullopt;
        }
    }
    return cut_to(parts, owned_, features_);
}

std::optional<SolveIterate> SolverCheckpointFiles::find_iterate() {
    std::vector<std::string> paths;
    if (comm_.is_root()) {
        for (const IterateFile& file : iterate_files(folder_)) paths.push_back(file.path);
    }
    broadcast(comm_, paths);
    const std::vector<IterateFile> all = iterate_files_of(paths);
    // Also an incomplete one: the next has another name.
    if (!all.empty()) generation_ = all.front().generation;
    for (std::size_t first = 0; first < all.size();) {
        std::size_t last = first;
        while (last < all.size() && all[last].generation == all[first].generation) ++last;
        const std::vector<IterateFile> files(all.begin() + static_cast<std::ptrdiff_t>(first),
                                             all.begin() + static_cast<std::ptrdiff_t>(last));
        first = last;
        if (!is_complete(files, size_)) continue;
        std::optional<SolveIterate> iterate = load_iterate(files);
        if (!every_rank(comm_, iterate.has_value())) continue;
        has_iterate_ = true;
        if (comm_.is_root()) ++found_;
        return iterate;
    }
    return std::nullopt;
}

CheckpointAction SolverCheckpointFiles::turn() {
    const std::chrono::duration<double> since = Clock::now() - last_write_;
    const bool due = any_rank(comm_, comm_.is_root() && since.count() >= state_.checkpoint_seconds());
    if (any_rank(comm_, state_.stop_is_raised())) return CheckpointAction::keep_and_stop;
    return due ? CheckpointAction::keep : CheckpointAction::go_on;
}

void SolverCheckpointFiles::keep_iterate(const SolveIterate& iterate) {
    ++generation_;
    agree(comm_, [&] {
        if (owned_.size() > 0) write_iterate(iterate_path(folder_, generation_, owned_), iterate, features_);
    });
    if (comm_.is_root()) {
        for (const IterateFile& file : iterate_files(folder_)) {
            std::error_code ignored;
            if (file.generation < generation_) fs::remove(file.path, ignored);
        }
        if (!has_iterate_) ++kept_;
    }
    has_iterate_ = true;
    last_write_ = Clock::now();
}

void SolverCheckpointFiles::close(bool stopped) {
    agree(comm_, [&] {
        if (failure_) throw Error(*failure_);
        flush();
    });
    const bool any_stopped = any_rank(comm_, stopped);
    const auto known = all_sum(comm_, std::int64_t{found_} + kept_);
    stop_.reset();
    if (any_stopped && has_iterate_) throw checkpointed("all meshes and the optimiser's iterate");
    if (any_stopped)
        throw checkpointed("all meshes and " + std::to_string(known) + " tiles of the optimiser");
}

}  // namespace coseg
