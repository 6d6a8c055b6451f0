#pragma once
// Walks through the tags of an XML text, one after the other and without making a tree of them.

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace coseg {

struct XmlTag {
    std::string_view name;
    bool begins = false;  ///< <a> and <a/>
    bool ends = false;    ///< </a> and <a/>
    /// Values are as they stand in the text: references such as &amp; are not replaced.
    std::vector<std::pair<std::string_view, std::string_view>> attributes = {};

    /// The value of the attribute, or `otherwise` if the tag has none of this name.
    [[nodiscard]] std::string_view attribute(std::string_view wanted, std::string_view otherwise = {}) const;
};

/// Works on memory that the caller keeps.
class XmlCursor {
  public:
    XmlCursor(std::string_view text, std::string path);

    /// The next tag; nothing if none is left. Comments and processing instructions are passed over. Throws
    /// Error(input) where a tag or a comment is cut short or not understood, and for declarations
    /// (<!DOCTYPE).
    std::optional<XmlTag> next_tag();

    /// The text between the last tag and what stands before it.
    [[nodiscard]] std::string_view text_before_tag() const { return text_before_; }

    /// The text behind the last tag, to its end.
    [[nodiscard]] std::string_view rest() const { return text_.substr(next_); }

    /// Throws Error(input) "PATH:LINE: sentence", with the line of the last tag.
    [[noreturn]] void fail(const std::string& sentence) const;

  private:
    [[nodiscard]] XmlTag tag_of(std::string_view inside) const;
    void pass_over(std::string_view beginning, std::string_view end);

    std::string_view text_;
    std::string path_;
    std::string_view text_before_;
    std::size_t tag_ = 0;   ///< where the last tag begins
    std::size_t next_ = 0;  ///< where the text behind it begins
};

}  // namespace coseg
