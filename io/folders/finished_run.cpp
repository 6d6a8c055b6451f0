#include "io/folders/finished_run.hpp"

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/data_files/result_files.hpp"
#include "io/files/content_hash.hpp"
#include "io/files/file_contents.hpp"
#include "io/files/json_failure.hpp"
#include "io/files/text_checksum.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

using Json = nlohmann::json;

/// A text of the mesh; its bytes stand beside it where they are not UTF-8.
std::string exact_text(const Json& mesh, const std::string& key) {
    const auto bytes = mesh.find(key + "_bytes");
    return bytes != mesh.end() ? bytes_of_hex(bytes->get<std::string>()) : mesh.at(key).get<std::string>();
}

/// Throws Error(input) for anything but a whole number in low .. high: a cast of a larger one, or of a
/// fraction, would give another number.
int whole_number(const Json& options, const std::string& key, int low, int high) {
    const Json& value = options.at(key);
    const bool is_within = value.is_number_integer() && !(value.is_number_unsigned() && value > high) &&
                           value >= low && value <= high;
    if (is_within) return value.get<int>();
    throw Error(ExitCode::input, "the option " + key + " is " + value.dump() + ", not in " +
                                     std::to_string(low) + " .. " + std::to_string(high));
}

/// A name is a part of paths that are read and written: it must not lead elsewhere.
std::string file_name_of(const Json& mesh) {
    std::string name = exact_text(mesh, "name");
    if (name.empty() || name.find('/') != std::string::npos || name.find('\0') != std::string::npos)
        throw Error(ExitCode::input, "the name of a mesh, '" + name + "', is not that of a file");
    return name;
}

/// Throws Error(input) if there is not a share from 0 to 1 for each part.
std::vector<double> shares_of(const Json& owner, int parts) {
    constexpr double rounding = 1e-6;
    auto shares = owner.at("part_area").get<std::vector<double>>();
    for (const double share : shares) {
        if (!(share >= 0.0 && share <= 1.0 + rounding))
            throw Error(ExitCode::input, "the share of a part is " + std::to_string(share));
    }
    if (shares.size() != static_cast<std::size_t>(parts))
        throw Error(ExitCode::input, "there are " + std::to_string(shares.size()) + " shares of " +
                                         std::to_string(parts) + " parts");
    return shares;
}

FinishedRun run_of(const std::string& folder, const Json& report) {
    constexpr int any = std::numeric_limits<int>::max();
    FinishedRun run;
    run.folder = folder;
    const Json& options = report.at("options");
    for (const auto& [key, value] : options.items())
        run.options.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    // Absolute there; the option is as it was given, relative to where the run was started.
    run.state = report.contains("state") ? report.at("state").at("folder").get<std::string>()
                                         : options.value("state", "");
    run.parts = whole_number(options, "parts", 1, any);
    run.seed = options.at("seed").get<std::uint64_t>();
    run.weld = options.value("weld", "auto");
    run.remesh = options.value("remesh", "auto");
    run.patches = whole_number(options, "patches", 2, 1000);
    run.geodesic_samples = whole_number(options, "geodesic-samples", 10, 5000);
    run.part_area = shares_of(report.at("partition"), run.parts);
    for (const Json& mesh : report.at("meshes")) {
        run.shapes.push_back({file_name_of(mesh), exact_text(mesh, "path"), shares_of(mesh, run.parts),
                              mesh.value("labels_xxh3", ""), mesh.value("patches_xxh3", "")});
    }
    if (run.shapes.empty()) throw Error(ExitCode::input, "it lists no shape");
    return run;
}

void add_if_changed(std::vector<std::string>& changed, const std::string& path, const std::string& checksum) {
    if (checksum.empty() || !std::filesystem::exists(path)) return;
    if (hash_bytes(read_regular_file(path)).hex() != checksum) changed.push_back(path);
}

FinishedRun checked_run_of(const std::string& folder, const Json& report) {
    try {
        return run_of(folder, report);
    } catch (const Error& error) {
        throw Error(error.code(), report_path(folder) + ": " + error.what() +
                                      "; correct what was edited, or run coseg run again");
    }
}

}  // namespace

std::string report_path(const std::string& folder) {
    return (std::filesystem::path(folder) / result_files::report).string();
}

FinishedRun read_finished_run(const std::string& folder) {
    const std::string path = report_path(folder);
    if (!std::filesystem::exists(path)) {
        throw Error(ExitCode::input, "'" + folder + "' holds no " + result_files::report +
                                         "; name the folder that coseg run was given with --out");
    }
    try {
        const std::string text = read_regular_file(path);
        const Json report = Json::parse(text);
        if (!report.at("format").get<std::string>().starts_with("coseg report"))
            throw Error(ExitCode::input, path + ": is not a report of coseg run");
        FinishedRun run = checked_run_of(folder, report);
        run.is_report_changed = !has_right_checksum(text);
        return run;
    } catch (const Json::exception& error) {
        throw Error(ExitCode::input, path + ": cannot be read as a report of coseg run (" +
                                         json_failure(error) + "); run coseg run again");
    }
}

std::string changed_file_sentence(const std::string& path) {
    return path + ": is not as the run wrote it, but damaged or edited";
}

std::vector<std::string> files_changed_since(const std::string& folder) {
    const FinishedRun run = read_finished_run(folder);
    std::vector<std::string> changed;
    if (run.is_report_changed) changed.push_back(report_path(folder));
    for (const FinishedShape& shape : run.shapes) {
        add_if_changed(changed, result_files::path_of(result_files::parts, folder, shape.name),
                       shape.labels_xxh3);
        add_if_changed(changed, result_files::path_of(result_files::patches, folder, shape.name),
                       shape.patches_xxh3);
    }
    return changed;
}

}  // namespace coseg
