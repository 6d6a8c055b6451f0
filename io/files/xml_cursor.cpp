#include "io/files/xml_cursor.hpp"

#include <algorithm>

#include "io/files/text_cursor.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view without_blanks_before(std::string_view text) {
    return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
}

/// The place of the '>' of the tag that begins at `begin`; one in quotation marks is not it.
std::size_t end_of_tag(std::string_view text, std::size_t begin) {
    std::size_t place = text.find_first_of(">\"'", begin);
    while (place != std::string_view::npos && text[place] != '>') {
        const std::size_t closing = text.find(text[place], place + 1);
        place = closing == std::string_view::npos ? closing : text.find_first_of(">\"'", closing + 1);
    }
    return place;
}

}  // namespace

std::string_view XmlTag::attribute(std::string_view wanted, std::string_view otherwise) const {
    for (const auto& [key, value] : attributes) {
        if (key == wanted) return value;
    }
    return otherwise;
}

XmlCursor::XmlCursor(std::string_view text, std::string path) : text_(text), path_(std::move(path)) {}

void XmlCursor::fail(const std::string& sentence) const {
    const std::string_view before = text_.substr(0, tag_);
    throw Error(
        ExitCode::input,
        path_ + ":" + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ": " + sentence);
}

void XmlCursor::pass_over(std::string_view beginning, std::string_view end) {
    const std::size_t found = text_.find(end, tag_ + beginning.size());
    if (found == std::string_view::npos)
        fail("'" + std::string(beginning) + "' is not ended by '" + std::string(end) +
             "'; export the mesh again");
    next_ = found + end.size();
}

XmlTag XmlCursor::tag_of(std::string_view inside) const {
    XmlTag tag;
    tag.begins = !inside.starts_with('/');
    tag.ends = !tag.begins || inside.ends_with('/');
    if (!tag.begins)
        inside.remove_prefix(1);
    else if (tag.ends)
        inside.remove_suffix(1);
    tag.name = inside.substr(0, inside.find_first_of(blanks));
    if (tag.name.empty()) fail("a tag has no name; export the mesh again");
    inside = without_blanks_before(inside.substr(tag.name.size()));
    while (!inside.empty()) {
        const std::size_t equals = inside.find('=');
        const std::string_view name =
            inside.substr(0, std::min(inside.find_first_of(blanks), std::min(equals, inside.size())));
        std::string_view value = equals == std::string_view::npos
                                     ? std::string_view()
                                     : without_blanks_before(inside.substr(equals + 1));
        const std::size_t end = value.empty() ? std::string_view::npos : value.find(value.front(), 1);
        if (end == std::string_view::npos || (value.front() != '"' && value.front() != '\''))
            fail("the tag " + in_quotes(tag.name) +
                 " has an attribute without a value in quotation marks; "
                 "export the mesh again");
        tag.attributes.emplace_back(name, value.substr(1, end - 1));
        inside = without_blanks_before(value.substr(end + 1));
    }
    return tag;
}

std::optional<XmlTag> XmlCursor::next_tag() {
    while (true) {
        const std::size_t begin = text_.find('<', next_);
        text_before_ = text_.substr(next_, begin == std::string_view::npos ? begin : begin - next_);
        if (begin == std::string_view::npos) return std::nullopt;
        tag_ = begin;
        const std::string_view rest = text_.substr(begin);
        if (rest.starts_with("<!--")) {
            pass_over("<!--", "-->");
        } else if (rest.starts_with("<?")) {
            pass_over("<?", "?>");
        } else if (rest.starts_with("<!")) {
            fail("declarations of XML ('<!') are not read; export the mesh again");
        } else {
            const std::size_t end = end_of_tag(text_, begin);
            if (end == std::string_view::npos) fail("a tag is cut short; export the mesh again");
            next_ = end + 1;
            return tag_of(text_.substr(begin + 1, end - begin - 1));
        }
    }
}

}  // namespace coseg
