#pragma once
// Reads back what a finished run left in its folder.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace coseg {

struct FinishedShape {
    std::string name;
    std::string path;               ///< of the mesh, as the run was given it
    std::vector<double> part_area;  ///< K, shares of the shape's area
    /// Checksums of its label files as the run wrote them; empty in reports of versions without them.
    std::string labels_xxh3;
    std::string patches_xxh3;
};

struct FinishedRun {
    /// Every option of the run as it was resolved: its name without dashes, and its value as on the command
    /// line.
    std::vector<std::pair<std::string, std::string>> options;
    std::string state;  ///< the folder of its state, "" for none
    std::string folder;
    /// Whether report.json has another checksum than the run gave it: it is damaged or edited.
    bool is_report_changed = false;
    int parts = 0;
    std::uint64_t seed = 1;
    std::string weld = "auto";
    std::string remesh = "auto";
    int patches = 50;  ///< like the next one, an option on which the descriptors depend
    int geodesic_samples = 300;
    std::vector<double> part_area;  ///< K, mean over the shapes
    std::vector<FinishedShape> shapes;
};

/// The path of the report of the run in this folder.
std::string report_path(const std::string& folder);

/// Reads DIR/report.json. Throws Error(input) if the folder holds no report, one that coseg has not written,
/// or one in which a number is impossible.
FinishedRun read_finished_run(const std::string& folder);

/// What to say of a file of a run that has another checksum than the run gave it.
std::string changed_file_sentence(const std::string& path);

/// The files of the run that have another checksum than the run gave them: report.json and label files.
/// Label files that are not there do not count. Throws Error(input) as read_finished_run() does, and for a
/// file that cannot be read.
std::vector<std::string> files_changed_since(const std::string& folder);

}  // namespace coseg
