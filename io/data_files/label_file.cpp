#include "io/data_files/label_file.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <system_error>

#include "io/files/atomic_file.hpp"
#include "io/files/file_contents.hpp"
#include "io/files/folder_entries.hpp"
#include "io/files/number_text.hpp"
#include "io/files/text_cursor.hpp"
#include "io/files/text_encoding.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

std::vector<std::string> label_file_names(const std::string& folder) {
    std::error_code cause;
    std::vector<std::string> names;
    for (const std::filesystem::path& path : folder_entries(folder, cause)) {
        const std::string name = path.stem().string();
        if (path.extension() == label_suffix && !name.starts_with('.')) names.push_back(name);
    }
    if (cause) throw Error(ExitCode::input, folder + ": the folder cannot be read (" + cause.message() + ")");
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<int> read_labels(const std::string& path, int expected_count) {
    return parse_labels(read_regular_file(path), path, expected_count);
}

std::vector<int> parse_labels(std::string_view bytes, const std::string& path, int expected_count) {
    const std::string text = utf8_text(std::string(bytes));
    TextCursor cursor(text, path, 0);
    std::vector<int> labels;
    while (cursor.next_line()) {
        const std::string_view word = cursor.word();
        std::int64_t label = 0;
        const bool fits = parse_integer(word, label) && label >= std::numeric_limits<int>::min() &&
                          label <= std::numeric_limits<int>::max();
        if (!fits || !cursor.word().empty()) {
            cursor.fail("a label file has one integer a line, but this line has " + in_quotes(word) +
                        (fits ? " and more" : ""));
        }
        labels.push_back(static_cast<int>(label));
    }
    if (expected_count >= 0 && labels.size() != at(expected_count)) {
        cursor.fail("the file ends with " + std::to_string(labels.size()) + " labels, but the mesh has " +
                    std::to_string(expected_count) +
                    " faces; give one label per face, in the mesh file's order");
    }
    return labels;
}

std::string label_text(const std::vector<int>& labels) {
    std::string content;
    content.reserve(2 * labels.size() + 16);
    for (const int label : labels) append_number(content, label, '\n');
    return content;
}

void write_labels(const std::string& path, const std::vector<int>& labels) {
    write_file(path, label_text(labels));
}

}  // namespace coseg
