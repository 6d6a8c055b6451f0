#include "io/mesh_files/off_header.hpp"

#include "io/mesh_files/mesh_limits.hpp"

namespace coseg {

namespace {

class OffHeaderReader {
  public:
    OffHeaderReader(std::string_view bytes, const std::string& path)
        : header_{.behind = {bytes, path, '#'}} {}

    OffHeader run() {
        if (!cursor().next_line()) cursor().fail("the file is empty; export the mesh again");
        const std::string_view keyword = cursor().word();
        std::int64_t number = 0;
        std::string_view next = keyword;
        if (!parse_integer(keyword, number)) {
            next = behind_keyword(keyword);
            if (next.empty()) next = cursor().word_on_any_line();
        }
        if (next == "BINARY")
            cursor().fail("binary OFF is not understood; export the mesh as ASCII OFF or PLY");
        if (has_dimension_) next = behind_dimension(next);
        header_.vertex_count = count(next, "vertices");
        const std::int64_t line = cursor().line();
        header_.face_count = count(cursor().word_on_any_line(), "faces");
        find_edge_count(cursor().line() == line);
        return std::move(header_);
    }

  private:
    TextCursor& cursor() { return header_.behind; }

    /// What follows the keyword in the same word: some collections write "OFF490 518 0".
    std::string_view behind_keyword(std::string_view word) {
        std::string_view rest = word;
        while (take_prefix(rest)) continue;
        if (!rest.starts_with("OFF") && !rest.starts_with("off") && !rest.starts_with("Off"))
            cursor().fail("an OFF file begins with OFF, this one with " + in_quotes(word));
        if (header_.has_weight) ++header_.coordinates;
        rest.remove_prefix(3);
        return rest;
    }

    bool take_prefix(std::string_view& rest) {
        const auto take = [&](std::string_view prefix, bool& flag) {
            if (!rest.starts_with(prefix)) return false;
            rest.remove_prefix(prefix.size());
            flag = true;
            return true;
        };
        return take("ST", header_.has_texture) || take("C", header_.has_colours) ||
               take("N", header_.has_normals) || take("4", header_.has_weight) || take("n", has_dimension_);
    }

    std::string_view behind_dimension(std::string_view word) {
        std::int64_t dimension = 0;
        if (!parse_integer(word, dimension) || dimension != 3) {
            cursor().fail("the vertices have the dimension " + in_quotes(word) +
                          ", only three are understood; export the mesh as plain OFF");
        }
        return cursor().word_on_any_line();
    }

    std::int64_t count(std::string_view word, const std::string& what) {
        std::int64_t value = 0;
        if (word.empty()) cursor().fail("the file ends in its header, before the number of " + what);
        if (!parse_integer(word, value) || value < 0 || value > most_vertices) {
            cursor().fail("the number of " + what + " in the header is " + in_quotes(word) +
                          ", which is no count");
        }
        return value;
    }

    /// Who writes each of the other counts on a line of its own writes all three.
    void find_edge_count(bool others_share_a_line) {
        if (!cursor().word().empty()) return;
        TextCursor ahead = cursor();
        std::int64_t edges = 0;
        const bool is_alone =
            ahead.next_line() && parse_integer(ahead.word(), edges) && edges >= 0 && ahead.word().empty();
        using enum OffHeader::EdgeCount;
        header_.edge_count = !is_alone ? absent : others_share_a_line ? maybe_on_next_line : on_next_line;
    }

    OffHeader header_;
    bool has_dimension_ = false;  ///< "n": the number of dimensions stands before the counts
};

}  // namespace

OffHeader read_off_header(std::string_view bytes, const std::string& path) {
    return OffHeaderReader(bytes, path).run();
}

}  // namespace coseg
