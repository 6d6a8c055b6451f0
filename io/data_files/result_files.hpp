#pragma once
// The names of what a run leaves in its folder of results, DIR. Who writes, reads or removes a result takes
// its name from here; docs/formats.md says what each file holds.

#include <array>
#include <string>

#include "io/data_files/label_file.hpp"

namespace coseg {

/// A result of which every mesh NAME has a file, DIR/FOLDER/NAME and the suffix.
struct MeshResult {
    const char* folder;
    const char* suffix;
};

namespace result_files {

inline constexpr const char* report = "report.json";
inline constexpr const char* corrections = "corrections.json";
inline constexpr const char* affinity = "affinity.png";
inline constexpr const char* alignment = "alignment.json";
inline constexpr const char* features = "features.h5";
inline constexpr const char* model = "model.h5";
inline constexpr const char* names = "names.txt";
inline constexpr const char* page = "report.html";
inline constexpr const char* profile = "profile.txt";
inline constexpr const char* trace = "trace.json";

/// Those that not every run writes: what an earlier run has left of them shows what is no longer there.
inline constexpr std::array<const char*, 8> of_some_runs{affinity, alignment, page,  profile,
                                                         trace,    model,     names, features};

/// A contact sheet is SHEET.png or SHEET_KIND.png. The pages of a large one lie in the folder of pages.
inline constexpr const char* sheet = "contact_sheet";
inline constexpr const char* picture_suffix = ".png";
inline constexpr MeshResult sheet_pages{"sheets", picture_suffix};

inline constexpr MeshResult parts{"labels", label_suffix};
inline constexpr MeshResult patches{"patches", label_suffix};
inline constexpr MeshResult colored_meshes{"ply", ".ply"};

/// What every run writes for each mesh.
inline constexpr std::array<MeshResult, 3> of_meshes{parts, patches, colored_meshes};

/// The labels of other numbers of parts than the run's are DIR/LEVELS/NUMBER/NAME and label_suffix.
inline constexpr const char* levels = "levels";

/// The path of the result of one mesh in the folder of results.
inline std::string path_of(const MeshResult& result, const std::string& folder, const std::string& mesh) {
    return folder + "/" + result.folder + "/" + mesh + result.suffix;
}

}  // namespace result_files

}  // namespace coseg
