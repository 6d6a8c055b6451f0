#pragma once
// Walks through the tags of an XML text, one after the other and without making a tree of them. Expat takes
// the text apart.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace coseg {

struct XmlTag {
    std::string name;
    bool begins = false;                                               ///< <a> and <a/>
    bool ends = false;                                                 ///< </a> and <a/>
    std::vector<std::pair<std::string, std::string>> attributes = {};  ///< in UTF-8, references replaced

    /// The value of the attribute, or `otherwise` if the tag has none of this name. It lives as long as the
    /// tag.
    [[nodiscard]] std::string_view attribute(std::string_view wanted, std::string_view otherwise = {}) const;
};

/// Works on memory that the caller keeps.
class XmlCursor {
  public:
    XmlCursor(std::string_view text, std::string path);
    ~XmlCursor();
    XmlCursor(const XmlCursor&) = delete;
    XmlCursor& operator=(const XmlCursor&) = delete;

    /// The next tag; nothing if none is left. Comments and processing instructions are passed over. Throws
    /// Error(input) where the text is cut short or no XML, and for declarations (<!DOCTYPE), so that no
    /// entity can be defined.
    std::optional<XmlTag> next_tag();

    /// The text between the last tag and what stands before it, as it stands there: references such as &amp;
    /// are not replaced.
    [[nodiscard]] std::string_view text_before_tag() const;

    /// The text behind the last tag, to its end. It need not be XML.
    [[nodiscard]] std::string_view rest() const;

    /// Throws Error(input) "PATH:LINE: sentence", with the line of the last tag.
    [[noreturn]] void fail(const std::string& sentence) const;

  private:
    class Parser;
    std::unique_ptr<Parser> parser_;
    std::string path_;
};

}  // namespace coseg
