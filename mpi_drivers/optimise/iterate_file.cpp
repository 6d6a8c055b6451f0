#include "mpi_drivers/optimise/iterate_file.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <tuple>

#include "io/files/folder_entries.hpp"
#include "io/files/record_file.hpp"
#include "mpi_drivers/process/source_fingerprint.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

constexpr const char* iterate_format = "coseg solver iterate";
constexpr int iterate_version = 4;

std::string iterate_name(int generation, BlockRange columns) {
    char text[80];
    std::snprintf(text, sizeof text, "iterate-%06d-%010lld-%010lld.h5", generation,
                  static_cast<long long>(columns.begin), static_cast<long long>(columns.end));
    return text;
}

std::optional<IterateFile> named(const fs::path& path) {
    const std::string name = path.filename().string();
    IterateFile file{.generation = 0, .columns = {}, .path = path.string()};
    long long begin = 0;
    long long end = 0;
    if (std::sscanf(name.c_str(), "iterate-%d-%lld-%lld.h5", &file.generation, &begin, &end) != 3)
        return std::nullopt;
    file.columns = {begin, end};
    if (name != iterate_name(file.generation, file.columns)) return std::nullopt;
    return file;
}

template <class T>
void append(std::vector<T>& all, const std::vector<T>& part, std::int64_t from, std::int64_t to) {
    all.insert(all.end(), part.begin() + from, part.begin() + to);
}

}  // namespace

std::string iterate_path(const std::string& folder, int generation, BlockRange columns) {
    return folder + "/" + iterate_name(generation, columns);
}

std::vector<IterateFile> iterate_files(const std::string& folder) {
    std::vector<std::string> paths;
    std::error_code ignored;
    for (const fs::path& path : folder_entries(folder, ignored)) paths.push_back(path.string());
    return iterate_files_of(paths);
}

std::vector<IterateFile> iterate_files_of(const std::vector<std::string>& paths) {
    std::vector<IterateFile> files;
    for (const std::string& path : paths) {
        if (std::optional<IterateFile> file = named(path)) files.push_back(*std::move(file));
    }
    std::sort(files.begin(), files.end(), [](const IterateFile& a, const IterateFile& b) {
        return std::tuple(-a.generation, a.columns.begin, a.columns.end) <
               std::tuple(-b.generation, b.columns.begin, b.columns.end);
    });
    return files;
}

bool is_complete(const std::vector<IterateFile>& files, std::int64_t size) {
    std::int64_t next = 0;
    for (const IterateFile& file : files) {
        if (file.columns.begin != next) return false;
        next = file.columns.end;
    }
    return next == size;
}

void write_iterate(const std::string& path, const SolveIterate& iterate, int features) {
    Hdf5Writer file(path, iterate_format, iterate_version);
    file.attribute("source_fingerprint", source_fingerprint(KeptPiece::solutions));
    file.attribute("features", std::int64_t{features});
    file.summary("solver, " + std::string(iterate.finished ? "end" : "iterate") + ", columns " +
                 std::to_string(iterate.columns.begin) + " to " + std::to_string(iterate.columns.end) + ", " +
                 std::to_string(iterate.rows.size()) + " pairs");
    write_record(file, "", iterate);
    file.commit();
}

SolveIterate read_iterate(const std::string& path) {
    SolveIterate iterate;
    read_record(Hdf5Reader(path, iterate_format, iterate_version), "", iterate);
    return iterate;
}

SolveIterate cut_to(const std::vector<SolveIterate>& parts, BlockRange wanted, int features) {
    SolveIterate result = parts.empty() ? SolveIterate{} : parts.front();  // what is the same on all ranks
    result.columns = wanted;
    result.offsets = {0};
    result.rows.clear();
    result.weights.clear();
    result.prices.clear();
    for (const SolveIterate& part : parts) {
        const std::int64_t begin = std::max(part.columns.begin, wanted.begin) - part.columns.begin;
        const std::int64_t end = std::min(part.columns.end, wanted.end) - part.columns.begin;
        if (begin >= end) continue;
        const std::int64_t first = part.offsets[at(begin)];
        const std::int64_t last = part.offsets[at(end)];
        for (std::int64_t c = begin + 1; c <= end; ++c) {
            result.offsets.push_back(static_cast<std::int64_t>(result.rows.size()) + part.offsets[at(c)] -
                                     first);
        }
        append(result.rows, part.rows, first, last);
        append(result.weights, part.weights, first * features, last * features);
        append(result.prices, part.prices, begin * features, end * features);
    }
    return result;
}

}  // namespace coseg
