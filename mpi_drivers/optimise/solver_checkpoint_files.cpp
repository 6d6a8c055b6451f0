#include "mpi_drivers/optimise/solver_checkpoint_files.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>

#include "io/files/hdf5_file.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

constexpr const char* tiles_format = "coseg solver tiles";
constexpr int tiles_version = 2;
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

template <class T>
void append(std::vector<T>& all, const std::vector<T>& part) {
    all.insert(all.end(), part.begin(), part.end());
}

/// The part [from, from + count) of all.
template <class T>
std::vector<T> part_of(const std::vector<T>& all, std::int64_t from, std::int64_t count) {
    return {all.begin() + from, all.begin() + from + count};
}

}  // namespace

ContentHash problem_key(const SubspaceProblem& problem, const SolveOptions& options) {
    // One name for each field: a new one does not compile until it has been thought of here.
    const auto& [features, alpha, beta, lambda, scope, mesh_of, allowed_meshes] = problem;
    const auto& [gap, max_iterations, max_seconds, solver, progress, checkpoint] = options;
    ContentHasher hasher;
    hasher.add(source_fingerprint());
    hasher.add(std::int64_t{tiles_version});
    for (const double number : {alpha, beta, lambda, gap}) hasher.add(number);
    hasher.add(max_iterations);
    hasher.add(solver);
    hasher.add(static_cast<int>(scope));
    hasher.add(std::span<const int>(mesh_of));
    for (const std::vector<int>& allowed : allowed_meshes) hasher.add(std::span<const int>(allowed));
    for (const Eigen::Index begin : features.offsets()) hasher.add(std::int64_t{begin});
    hasher.add(std::span<const double>(features.data(),
                                       static_cast<std::size_t>(features.dimension() * features.columns())));
    static_cast<void>(max_seconds);  // a tile that the clock cut short is not kept
    static_cast<void>(progress);
    static_cast<void>(checkpoint);
    return hasher.result();
}

void write_tiles(const std::string& path, const std::vector<SolvedTile>& tiles, int features) {
    SolvedTile all;
    std::vector<std::int64_t> begins, ends, pairs, working;
    std::vector<std::int32_t> iterations, passes;
    std::vector<double> residuals;
    std::vector<std::int8_t> limited;
    std::vector<std::int64_t> round_counts, round_steps;
    std::vector<double> round_numbers;
    for (const SolvedTile& tile : tiles) {
        begins.push_back(tile.begin);
        ends.push_back(tile.end);
        pairs.push_back(tile.offsets.back());
        working.push_back(tile.working_pairs);
        iterations.push_back(tile.iterations);
        passes.push_back(tile.passes);
        residuals.push_back(tile.residual);
        limited.push_back(tile.limited ? 1 : 0);
        round_counts.push_back(static_cast<std::int64_t>(tile.rounds.size()));
        for (const auto& [reached, bound, so_far, round_pairs] : tile.rounds) {
            round_numbers.insert(round_numbers.end(), {reached, bound});
            round_steps.insert(round_steps.end(), {so_far, round_pairs});
        }
        append(all.offsets, tile.offsets);
        append(all.rows, tile.rows);
        append(all.values, tile.values);
        append(all.decrease, tile.decrease);
        append(all.largest_decrease, tile.largest_decrease);
    }
    Hdf5Writer file(path, tiles_format, tiles_version);
    file.attribute("features", std::int64_t{features});
    file.attribute("source_fingerprint", source_fingerprint());
    file.summary("solver, columns " + std::to_string(begins.front()) + " to " + std::to_string(ends.back()) +
                 ", " + std::to_string(all.rows.size()) + " pairs");
    file.write("tile/begin", begins);
    file.write("tile/end", ends);
    file.write("tile/pairs", pairs);
    file.write("tile/working_pairs", working);
    file.write("tile/iterations", iterations);
    file.write("tile/passes", passes);
    file.write("tile/residual", residuals);
    file.write("tile/limited", limited);
    file.write("tile/rounds", round_counts);
    file.write("round/numbers", round_numbers, {round_numbers.size() / 2, 2});
    file.write("round/counts", round_steps, {round_steps.size() / 2, 2});
    file.write("offsets", all.offsets);
    file.write("rows", all.rows);
    file.write("values", all.values, {all.rows.size(), static_cast<std::uint64_t>(features)});
    file.write("decrease", all.decrease);
    file.write("largest_decrease", all.largest_decrease);
    file.commit();
}

std::vector<SolvedTile> read_tiles(const std::string& path) {
    const Hdf5Reader file(path, tiles_format, tiles_version);
    const auto begins = file.read<std::int64_t>("tile/begin");
    const auto ends = file.read<std::int64_t>("tile/end");
    const auto pairs = file.read<std::int64_t>("tile/pairs");
    const auto working = file.read<std::int64_t>("tile/working_pairs");
    const auto iterations = file.read<std::int32_t>("tile/iterations");
    const auto passes = file.read<std::int32_t>("tile/passes");
    const auto residuals = file.read<double>("tile/residual");
    const auto limited = file.read<std::int8_t>("tile/limited");
    const auto round_counts = file.read<std::int64_t>("tile/rounds");
    const auto round_numbers = file.read<double>("round/numbers");
    const auto round_steps = file.read<std::int64_t>("round/counts");
    const auto offsets = file.read<std::int64_t>("offsets");
    const auto rows = file.read<std::int32_t>("rows");
    const auto values = file.read<double>("values");
    const auto decrease = file.read<double>("decrease");
    const auto largest_decrease = file.read<double>("largest_decrease");
    const std::int64_t features = file.integer("features");
    std::vector<SolvedTile> tiles;
    std::int64_t column = 0;
    std::int64_t pair = 0;
    std::size_t round = 0;
    for (std::size_t t = 0; t < begins.size(); ++t) {
        const std::int64_t columns = ends[t] - begins[t];
        tiles.push_back({.begin = begins[t],
                         .end = ends[t],
                         .offsets = part_of(offsets, column + static_cast<std::int64_t>(t), columns + 1),
                         .rows = part_of(rows, pair, pairs[t]),
                         .values = part_of(values, pair * features, pairs[t] * features),
                         .decrease = part_of(decrease, column, columns),
                         .largest_decrease = part_of(largest_decrease, column, columns),
                         .residual = residuals[t],
                         .iterations = iterations[t],
                         .passes = passes[t],
                         .working_pairs = working[t],
                         .limited = limited[t] != 0,
                         .rounds = {}});
        for (std::int64_t k = 0; k < round_counts[t]; ++k, round += 2) {
            tiles.back().rounds.push_back({round_numbers.at(round), round_numbers.at(round + 1),
                                           static_cast<int>(round_steps.at(round)),
                                           round_steps.at(round + 1)});
        }
        column += columns;
        pair += pairs[t];
    }
    return tiles;
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
    std::error_code cause;
    for (fs::directory_iterator entry(folder_, cause), end; !cause && entry != end; entry.increment(cause)) {
        const std::optional<BlockRange> columns = columns_of(entry->path().filename().string());
        if (columns && columns->begin < owned.end && columns->end > owned.begin)
            files_.push_back({*columns, entry->path().string()});
    }
    std::sort(files_.begin(), files_.end(),
              [](const TileFile& a, const TileFile& b) { return a.path < b.path; });
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
    broadcast_texts(comm_, paths);
    const std::vector<IterateFile> all = iterate_files_of(paths);
    if (!all.empty())
        generation_ = all.front().generation;  // also an incomplete one: the next has another name
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
    const double due = comm_.is_root() && since.count() >= state_.checkpoint_seconds() ? 1.0 : 0.0;
    const double most = all_max(comm_, state_.stop_is_raised() ? 2.0 : due);
    if (most == 0.0) return CheckpointAction::go_on;
    return most == 1.0 ? CheckpointAction::keep : CheckpointAction::keep_and_stop;
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
