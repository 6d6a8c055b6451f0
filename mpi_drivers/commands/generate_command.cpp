// `coseg generate`: collections of made shapes with their truth, spread over the ranks shape by shape.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "io/data_files/label_file.hpp"
#include "io/data_files/name_file.hpp"
#include "io/files/atomic_file.hpp"
#include "io/files/folder_entries.hpp"
#include "io/mesh_files/off_format.hpp"
#include "mpi_drivers/options/command.hpp"
#include "mpi_drivers/options/option_checks.hpp"
#include "src/base/error.hpp"
#include "src/families/shape_families.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

struct GenerateOptions {
    std::string family;
    int count = 20;
    std::uint64_t seed = 1;
    int faces = 5000;
    std::string out;
    bool force = false;
    bool list = false;
};

void print_families() {
    for (const ShapeFamily& family : shape_families()) {
        std::string labels;
        for (const std::string& label : family.labels) labels += (labels.empty() ? "" : ", ") + label;
        std::cout << family.name << std::string(family.name.size() < 12 ? 12 - family.name.size() : 1, ' ')
                  << family.description << " (" << labels << ")\n";
    }
    std::cout.flush();
}

/// FAMILY_0007; as many digits as the largest index needs, four at least.
std::string shape_name(const std::string& family, int index, int count) {
    const std::string digits = std::to_string(index);
    const std::size_t width = std::max<std::size_t>(4, std::to_string(count - 1).size());
    return family + "_" + std::string(width - digits.size(), '0') + digits;
}

/// Whether an earlier `generate` may have written this file: a family, an underscore, digits.
bool is_generated_name(const std::string& stem) {
    const std::size_t underscore = stem.rfind('_');
    if (underscore == std::string::npos || underscore + 5 > stem.size()) return false;
    const std::string family = stem.substr(0, underscore);
    return std::all_of(stem.begin() + static_cast<std::ptrdiff_t>(underscore) + 1, stem.end(),
                       [](char c) { return c >= '0' && c <= '9'; }) &&
           std::any_of(shape_families().begin(), shape_families().end(),
                       [&](const ShapeFamily& f) { return f.name == family; });
}

/// So that a smaller collection written over a larger one does not mix with its rest.
void remove_earlier_shapes(const fs::path& folder, const std::string& extension) {
    remove_earlier_files(folder, [&](const fs::path& path) {
        return path.extension() == extension && is_generated_name(path.stem().string());
    });
}

void prepare_folders(const GenerateOptions& options) {
    const fs::path out(options.out);
    try {
        if (fs::exists(out) && !fs::is_directory(out)) {
            throw Error(ExitCode::output, "'" + options.out + "' is a file; name a folder with --out");
        }
        if (fs::exists(out) && !fs::is_empty(out) && !options.force) {
            throw Error(ExitCode::output,
                        "the folder '" + options.out +
                            "' is not empty; name another with --out, or write into it with --force");
        }
        remove_earlier_shapes(out / "meshes", ".off");
        remove_earlier_shapes(out / "truth", label_suffix);
        fs::create_directories(out / "meshes");
        fs::create_directories(out / "truth");
    } catch (const fs::filesystem_error& error) {
        throw Error(ExitCode::output,
                    "the folder '" + options.out + "' cannot be prepared: " + error.code().message());
    }
}

LabelNames numbered(const std::vector<std::string>& names) {
    LabelNames of_labels;
    for (std::size_t label = 0; label < names.size(); ++label)
        of_labels.emplace(static_cast<int>(label), names[label]);
    return of_labels;
}

void write_shape(const GenerateOptions& options, int index) {
    const LabeledShape shape = generate_shape(options.family, options.seed, index, options.faces);
    const std::string name = shape_name(options.family, index, options.count);
    write_off(options.out + "/meshes/" + name + ".off", shape.mesh);
    write_labels(options.out + "/truth/" + name + label_suffix, shape.face_label);
}

/// Collective over the invocation's ranks.
void generate(const GenerateOptions& options, const Comm& world) {
    if (options.list || options.family == "list") {
        if (world.is_root()) print_families();
        return;
    }
    agree(world, [&] {
        if (options.family.empty()) throw Error(ExitCode::usage, "name a family, or list them with --list");
        const ShapeFamily& family = shape_family(options.family);
        if (options.out.empty()) throw Error(ExitCode::usage, "name the folder to write into with --out");
        if (!world.is_root()) return;
        prepare_folders(options);
        write_file(options.out + "/truth/" + truth_names_file, names_text(numbered(family.labels)));
    });
    agree(world, [&] {
        for (int index = world.rank(); index < options.count; index += world.size())
            write_shape(options, index);
    });
    if (world.is_root()) {
        std::cout << "wrote " << options.count << " shapes of the family " << options.family << " to "
                  << options.out << "/meshes, their labels to " << options.out << "/truth" << std::endl;
    }
}

}  // namespace

Command add_generate_command(CLI::App& parent) {
    const auto options = std::make_shared<GenerateOptions>();
    CLI::App* app =
        parent.add_subcommand("generate", "Make a collection of shapes of one family, with truth labels");
    app->add_option("FAMILY", options->family, "The family; `list` prints them all");
    app->add_option("--count", options->count, "Number of shapes")
        ->capture_default_str()
        ->check(CLI::Range(1, most_generated_shapes))
        ->transform(decimal_digits);
    app->add_option("--seed", options->seed, "The same seed gives the same shapes")
        ->check(unsigned_number)
        ->transform(decimal_digits)
        ->capture_default_str();
    app->add_option("--faces", options->faces, "Faces per shape, met within 15 %")
        ->capture_default_str()
        ->check(CLI::Range(least_generated_faces, most_generated_faces))
        ->transform(decimal_digits);
    app->add_option("--out", options->out,
                    "Folder to write into: meshes/NAME.off, truth/NAME.seg, truth/labels.txt");
    app->add_flag("--force", options->force,
                  "Write into a folder that is not empty, over the shapes generated before");
    app->add_flag("--list", options->list, "Print the families and their labels");
    return {app, [options](const Invocation& invocation) { generate(*options, invocation.world); }};
}

}  // namespace coseg
