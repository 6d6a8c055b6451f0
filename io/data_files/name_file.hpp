#pragma once
// Names of labels, labels.txt: a name a line, or a number and its name as `coseg generate` writes them.

#include <map>
#include <string>

namespace coseg {

/// Name of each label; labels without a name are not in it.
using LabelNames = std::map<int, std::string>;

/// Where every line begins with a number of 0 and above, and a name follows, that is the label; else the lines are labels
/// 0, 1, ... in their order. Blank lines are passed over, white space around a name is not part of it.
/// Throws Error(input) naming the path if it cannot be read or has no name, and the line if a label is named twice.
LabelNames read_names(const std::string& path);

}  // namespace coseg
