// coseg check: what a run would say of meshes, without the run.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/files/atomic_file.hpp"
#include "io/mesh_files/mesh_format.hpp"
#include "io/reports/record_json.hpp"
#include "mpi_drivers/describe/mesh_check.hpp"
#include "mpi_drivers/describe/mesh_stage.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "mpi_drivers/options/weld_option.hpp"
#include "src/base/error.hpp"
#include "src/base/text.hpp"

namespace coseg {

namespace {

struct CheckOptions {
    std::vector<std::string> inputs;
    std::string json;  ///< a file, or empty
    WeldChoice weld = {};
};

struct CheckTotals {
    int meshes = 0;
    int warned = 0;  ///< usable, with something to say
    int set_aside = 0;
    static constexpr auto fields() {
        return std::tuple(field("meshes", &CheckTotals::meshes), field("warned", &CheckTotals::warned),
                          field("set_aside", &CheckTotals::set_aside));
    }
};

/// A mesh as in the file of --json.
struct CheckRow {
    CheckedMesh mesh;
    std::optional<std::string> name_bytes;  ///< as in report.json
    std::optional<std::string> path_bytes;
    static constexpr auto fields() {
        return std::tuple(inlined(&CheckRow::mesh), field("name_bytes", &CheckRow::name_bytes),
                          field("path_bytes", &CheckRow::path_bytes));
    }
};

/// Names may hold anything, but a mesh has one line.
std::string on_one_line(std::string text) {
    for (char& c : text) {
        if (c >= 0 && c < ' ') c = '?';
    }
    return text;
}

/// The sentence without the path with which it begins; a number of a line stays.
std::string without_path(const std::string& sentence, const std::string& path) {
    if (!sentence.starts_with(path + ":")) return sentence;
    const std::string rest = sentence.substr(path.size() + 1);
    return rest.starts_with(" ") ? rest.substr(1) : "line " + rest;
}

std::string line_of(const CheckedMesh& mesh) {
    if (!mesh.set_aside.empty())
        return on_one_line(mesh.path + ": set aside: " + without_path(mesh.set_aside, mesh.path));
    std::string line = mesh.path + ": " + with_unit(mesh.vertices, "vertex", "vertices") + ", " +
                       with_unit(mesh.faces, "face", "faces") + ", " +
                       with_unit(mesh.pieces, "piece", "pieces");
    for (const std::string& warning : mesh.warnings) line += "; " + without_path(warning, mesh.path);
    return on_one_line(line);
}

CheckTotals totals_of(const std::vector<CheckedMesh>& meshes) {
    CheckTotals totals;
    for (const CheckedMesh& mesh : meshes) {
        ++totals.meshes;
        if (!mesh.set_aside.empty())
            ++totals.set_aside;
        else if (!mesh.warnings.empty())
            ++totals.warned;
    }
    return totals;
}

void write_json(const std::string& path, const std::vector<CheckedMesh>& meshes, const CheckTotals& totals) {
    std::vector<CheckRow> rows;
    for (const CheckedMesh& mesh : meshes)
        rows.push_back({mesh, hex_unless_utf8(mesh.name), hex_unless_utf8(mesh.path)});
    JsonTree tree;
    tree.root().member("format").set("coseg check 1");
    set_json(tree.root().member("totals"), totals);
    set_json(tree.root().member("meshes"), rows);
    write_file(path, tree.pretty() + "\n");
}

void print(const std::vector<CheckedMesh>& meshes, const CheckTotals& totals) {
    for (const CheckedMesh& mesh : meshes) std::cout << line_of(mesh) << '\n';
    std::cout << with_unit(totals.meshes, "mesh", "meshes") << ": "
              << totals.meshes - totals.warned - totals.set_aside << " as they are, " << totals.warned
              << " with something to repair or to know, " << totals.set_aside << " set aside" << std::endl;
}

/// `--json chairs/*.off` would take the first mesh for the file to write.
void refuse_json_over_mesh(const std::string& json, std::vector<std::string> inputs,
                           const std::vector<MeshEntry>& entries) {
    if (json.empty()) return;
    if (readable_format_of(json) != nullptr)
        throw Error(ExitCode::usage, "--json: '" + json +
                                         "' has the name of a mesh, which would be overwritten; name a file "
                                         "for the findings, such as check.json");
    for (const MeshEntry& entry : entries) inputs.push_back(entry.path);
    check_output_files({{"--json", json}}, inputs);
}

void check(const Comm& world, const CheckOptions& options) {
    const std::vector<MeshEntry> entries = list_meshes(world, options.inputs);
    agree(world, [&] {
        if (world.is_root()) refuse_json_over_mesh(options.json, options.inputs, entries);
    });
    const std::vector<CheckedMesh> meshes = check_meshes(world, entries, border_limits(options.weld));
    std::int64_t set_aside = 0;
    agree(world, [&] {
        if (!world.is_root()) return;
        const CheckTotals totals = totals_of(meshes);
        set_aside = totals.set_aside;
        print(meshes, totals);
        if (!options.json.empty()) write_json(options.json, meshes, totals);
    });
    set_aside = all_sum(world, set_aside);
    if (set_aside == 0) return;
    throw AgreedError(ExitCode::input, std::to_string(set_aside) + " of " + std::to_string(entries.size()) +
                                           " meshes would be set aside; a run goes on without them, and "
                                           "--strict ends it");
}

}  // namespace

Command add_check_command(CLI::App& parent) {
    const auto options = std::make_shared<CheckOptions>();
    CLI::App* app = parent.add_subcommand(
        "check", "Read meshes as a run would, and say what it would repair or set aside");
    app->add_option(
           "input", options->inputs,
           "Meshes (" + readable_formats() + "), folders of them, or @LIST: a file with a path a line")
        ->required()
        ->type_name("MESH|DIRECTORY|@LIST");
    app->add_option("--json", options->json, "Write the same into this file, as JSON")->type_name("FILE");
    add_weld_option(*app, options->weld);
    app->footer("Exit code: 0 if a run would use every mesh, repaired or not; 3 if it would set one aside.");
    return {app, [options](const Invocation& invocation) { check(invocation.world, *options); }};
}

}  // namespace coseg
