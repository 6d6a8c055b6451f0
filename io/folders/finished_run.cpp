#include "io/folders/finished_run.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/files/file_contents.hpp"
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

FinishedRun run_of(const std::string& folder, const Json& report) {
    FinishedRun run;
    run.folder = folder;
    const Json& options = report.at("options");
    for (const auto& [key, value] : options.items())
        run.options.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    run.state = options.value("state", "");
    run.parts = options.at("parts").get<int>();
    run.seed = options.at("seed").get<std::uint64_t>();
    run.weld = options.value("weld", "auto");
    run.remesh = options.value("remesh", "auto");
    run.patches = options.at("patches").get<int>();
    run.geodesic_samples = options.at("geodesic-samples").get<int>();
    run.part_area = report.at("partition").at("part_area").get<std::vector<double>>();
    for (const Json& mesh : report.at("meshes")) {
        run.shapes.push_back({exact_text(mesh, "name"), exact_text(mesh, "path"),
                              mesh.at("part_area").get<std::vector<double>>(), mesh.value("labels_xxh3", ""),
                              mesh.value("patches_xxh3", "")});
    }
    return run;
}

}  // namespace

FinishedRun read_finished_run(const std::string& folder) {
    const std::string path = (std::filesystem::path(folder) / "report.json").string();
    if (!std::filesystem::exists(path)) {
        throw Error(
            ExitCode::input,
            "'" + folder + "' holds no report.json; name the folder that coseg run was given with --out");
    }
    try {
        const Json report = Json::parse(read_file(path));
        if (!report.at("format").get<std::string>().starts_with("coseg report"))
            throw Error(ExitCode::input, path + ": is not a report of coseg run");
        FinishedRun run = run_of(folder, report);
        if (run.shapes.empty()) throw Error(ExitCode::input, path + ": lists no shape");
        if (run.parts < 1 || run.part_area.size() != static_cast<std::size_t>(run.parts))
            throw Error(ExitCode::input,
                        path + ": its parts do not agree with each other; run coseg run again");
        return run;
    } catch (const Json::exception& error) {
        throw Error(ExitCode::input, path + ": cannot be read as a report of coseg run (" + error.what() +
                                         "); run coseg run again");
    }
}

}  // namespace coseg
