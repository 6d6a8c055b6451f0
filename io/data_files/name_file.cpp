#include "io/data_files/name_file.hpp"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>
#include <vector>

#include "io/data_files/result_files.hpp"
#include "io/files/file_contents.hpp"
#include "io/files/text_cursor.hpp"
#include "io/files/text_encoding.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

struct NamedLine {
    std::int64_t line = 0;  ///< of the file
    std::vector<std::string> words;
};

std::vector<NamedLine> lines_with_words(const std::string& bytes, const std::string& path) {
    TextCursor cursor(bytes, path, 0);
    std::vector<NamedLine> lines;
    while (cursor.next_line()) {
        NamedLine line{cursor.line(), {}};
        for (std::string_view word = cursor.word(); !word.empty(); word = cursor.word())
            line.words.emplace_back(word);
        lines.push_back(line);
    }
    if (lines.empty()) cursor.fail("no name in the file; give one a line, or a number and a name");
    return lines;
}

/// The label that a line "3 wing" begins with, else -1.
int leading_label(const NamedLine& line) {
    std::int64_t label = -1;
    const bool fits = line.words.size() > 1 && parse_integer(line.words.front(), label) && label >= 0 &&
                      label <= std::numeric_limits<int>::max();
    return fits ? static_cast<int>(label) : -1;
}

std::string joined(const std::vector<std::string>& words, std::size_t begin) {
    std::string text;
    for (std::size_t k = begin; k < words.size(); ++k) text += (k > begin ? " " : "") + words[k];
    return text;
}

LabelNames parse_names(std::string bytes, const std::string& path) {
    const std::vector<NamedLine> lines = lines_with_words(utf8_text(std::move(bytes)), path);
    bool numbered = true;
    for (const NamedLine& line : lines) numbered = numbered && leading_label(line) >= 0;
    LabelNames names;
    for (const NamedLine& line : lines) {
        const int label = numbered ? leading_label(line) : static_cast<int>(names.size());
        if (!names.emplace(label, joined(line.words, numbered ? 1 : 0)).second)
            throw Error(ExitCode::input, path + ":" + std::to_string(line.line) + ": label " +
                                             std::to_string(label) + " has a name already");
    }
    return names;
}

LabelNames names_if_there(const std::string& path) {
    std::error_code ignored;
    return std::filesystem::exists(path, ignored) ? read_found_names(path) : LabelNames();
}

}  // namespace

LabelNames read_names(const std::string& path) { return parse_names(read_file(path), path); }

LabelNames read_found_names(const std::string& path) { return parse_names(read_regular_file(path), path); }

LabelNames names_in_folder(const std::string& folder) {
    return names_if_there(folder + "/" + result_files::names);
}

LabelNames names_beside_truth(const std::string& folder) {
    return folder.empty() ? LabelNames() : names_if_there(folder + "/" + truth_names_file);
}

void refuse_names_beyond(const LabelNames& names, int count, const std::string& path) {
    if (names.empty() || names.rbegin()->first < count) return;
    throw Error(ExitCode::input, path + ": label " + std::to_string(names.rbegin()->first) +
                                     " has a name, but there are " + std::to_string(count) +
                                     " parts; labels count from 0");
}

std::string names_text(const LabelNames& names) {
    std::string text;
    for (const auto& [label, name] : names) text += std::to_string(label) + " " + name + "\n";
    return text;
}

}  // namespace coseg
