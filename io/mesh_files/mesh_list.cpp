#include "io/mesh_files/mesh_list.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <tuple>

#include "io/files/file_contents.hpp"
#include "io/files/folder_entries.hpp"
#include "io/files/text_encoding.hpp"
#include "io/mesh_files/mesh_format.hpp"
#include "io/mesh_files/mesh_reader.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& sentence) { throw Error(ExitCode::input, sentence); }

class MeshListExpander {
  public:
    void add_argument(const std::string& argument) {
        if (argument.size() > 1 && argument[0] == '@')
            add_list(argument.substr(1));
        else
            add_path(argument, "");
    }

    std::vector<MeshEntry> take() {
        if (found_.empty()) fail("no mesh is given; name mesh files, folders or @LIST files");
        std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) {
            return std::tie(a.entry.name, b.is_file) < std::tie(b.entry.name, a.is_file);
        });
        std::vector<MeshEntry> entries;
        for (Found& found : found_) {
            const bool is_taken = !entries.empty() && entries.back().name == found.entry.name;
            if (is_taken && found.is_file) {
                fail("two meshes are named '" + found.entry.name + "': " + entries.back().path + " and " +
                     found.entry.path + "; rename one or give it once");
            }
            if (!is_taken) entries.push_back(std::move(found.entry));
        }
        return entries;
    }

  private:
    /// `where` is empty or "LIST:LINE: ", for messages.
    void add_path(const fs::path& path, const std::string& where) {
        std::error_code cause;
        const fs::file_status status = fs::status(path, cause);
        if (!fs::exists(status)) fail(where + path.string() + ": no such file or folder; check the path");
        if (fs::is_directory(status))
            add_directory(path, where);
        else
            add_file(path, where);
    }

    void add_directory(const fs::path& folder, const std::string& where) {
        std::error_code cause;
        const std::size_t before = found_.size();
        for (const fs::path& path : folder_entries(folder, cause)) {
            const bool is_hidden = path.filename().string().starts_with(".");
            if (!is_hidden && has_mesh_extension(path.string())) add_entry(path);
        }
        if (cause) fail(where + folder.string() + ": the folder cannot be read (" + cause.message() + ")");
        if (found_.size() == before) {
            fail(where + folder.string() + ": the folder has no " + readable_suffixes("or") +
                 " files; name the folder that holds the meshes");
        }
    }

    void add_file(const fs::path& path, const std::string& where) {
        if (!has_mesh_extension(path.string())) {
            fail(where + path.string() + ": meshes are read from " + readable_suffixes("and") +
                 " files; a list of meshes is given as @" + path.string());
        }
        add_entry(path);
    }

    /// Whether the entry can be read shows when it is: a bad one costs itself, not the run.
    void add_entry(const fs::path& path) {
        std::error_code cause;
        const bool is_file = fs::is_regular_file(path, cause);
        const std::uintmax_t bytes = is_file ? fs::file_size(path, cause) : 0;
        found_.push_back({{path.stem().string(), path.string(), cause ? 0 : bytes, nullptr}, is_file});
    }

    void add_list(const std::string& list) {
        const std::string text = utf8_text(read_file(list));
        if (text.find('\0') != std::string::npos)
            fail(list + ": the list has zero bytes, as of find -print0; write one path a line");
        const std::size_t before = found_.size();
        int number = 0;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            const std::string line = without_comment(text.substr(begin, end - begin));
            begin = end + 1;
            ++number;
            if (!line.empty()) add_path(located(line, list), list + ":" + std::to_string(number) + ": ");
        }
        if (found_.size() == before) fail(list + ": the list names no meshes; write one path a line");
    }

    static std::string without_comment(std::string line) {
        constexpr const char* blanks = " \t\r\v\f";
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i] != '#' || (i > 0 && line[i - 1] != ' ' && line[i - 1] != '\t')) continue;
            line.resize(i);
            break;
        }
        const std::size_t first = line.find_first_not_of(blanks);
        if (first == std::string::npos) return {};
        return line.substr(first, line.find_last_not_of(blanks) - first + 1);
    }

    static fs::path located(const fs::path& path, const fs::path& list) {
        if (path.is_absolute()) return path;
        const fs::path beside = list.parent_path() / path;
        std::error_code ignored;
        return fs::exists(beside, ignored) || !fs::exists(path, ignored) ? beside : path;
    }

    struct Found {
        MeshEntry entry;
        bool is_file;
    };
    std::vector<Found> found_;
};

}  // namespace

std::vector<MeshEntry> expand_mesh_list(const std::vector<std::string>& arguments) {
    MeshListExpander expander;
    for (const std::string& argument : arguments) expander.add_argument(argument);
    return expander.take();
}

}  // namespace coseg
