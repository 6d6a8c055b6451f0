#pragma once
// Reads names of labels (labels.txt): a name a line, or a number and its name as `coseg generate` writes
// them.

#include <map>
#include <string>

namespace coseg {

/// The name of each label that has one.
using LabelNames = std::map<int, std::string>;

/// If every line begins with a number of at least 0, followed by a name, the number is the label. Otherwise
/// the lines are the labels 0, 1, ... in their order. Blank lines are skipped, and white space around a
/// name is not part of it. The text is in UTF-8 or UTF-16. Throws Error(input) naming the path if it cannot
/// be read or has no name, and the line if a label is named twice.
LabelNames read_names(const std::string& path);

/// The same for a file that was found in a folder and not named by the user: a pipe or a device there is
/// refused with Error(input), as reading it could wait for ever.
LabelNames read_found_names(const std::string& path);

/// The names in FOLDER/names.txt; none where there is no such file. Throws as read_found_names.
LabelNames names_in_folder(const std::string& folder);

/// The file beside true labels that names them, as `coseg generate` writes it.
inline constexpr const char* truth_names_file = "labels.txt";

/// The names in FOLDER/labels.txt; none where `folder` is empty or there is no such file. Throws as
/// read_found_names.
LabelNames names_beside_truth(const std::string& folder);

/// Throws Error(input) naming the path where a label other than 0 .. count - 1 has a name, as if labels were
/// counted from 1.
void refuse_names_beyond(const LabelNames& names, int count, const std::string& path);

/// The text of such a file: the number and the name of each label, a line each.
std::string names_text(const LabelNames& names);

}  // namespace coseg
