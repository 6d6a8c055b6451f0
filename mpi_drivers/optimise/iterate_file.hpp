#pragma once
// Keeps the iterate of row scope as files of a state folder, one for each rank. Any number of ranks can
// continue from them.

#include <optional>
#include <string>
#include <vector>

#include "solvers/subspace/solver_checkpoint.hpp"

namespace coseg {

/// A file of one generation of the iterate: FOLDER/iterate-GENERATION-BEGIN-END.h5 holds the columns BEGIN ..
/// END.
struct IterateFile {
    int generation = 0;
    BlockRange columns;
    std::string path;
};

std::string iterate_path(const std::string& folder, int generation, BlockRange columns);

/// All such files of a folder, by generation, newest first, then by column.
std::vector<IterateFile> iterate_files(const std::string& folder);

/// Those of the paths that are named like such a file, in the same order.
std::vector<IterateFile> iterate_files_of(const std::vector<std::string>& paths);

/// Whether the files, of one generation and by column, hold the columns 0 .. size without a gap.
bool is_complete(const std::vector<IterateFile>& files, std::int64_t size);

/// Throws Error(output).
void write_iterate(const std::string& path, const SolveIterate& iterate, int features);
/// Throws Error(input) for a damaged file.
SolveIterate read_iterate(const std::string& path);

/// The columns `wanted` of iterates that hold adjacent columns and together all that are wanted.
SolveIterate cut_to(const std::vector<SolveIterate>& parts, BlockRange wanted, int features);

}  // namespace coseg
