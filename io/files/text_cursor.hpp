#pragma once
// Walks through text line by line and word by word, and knows the line for messages.

#include <cstdint>
#include <string>
#include <string_view>

namespace coseg {

/// Lines end in LF, CR LF or CR; words are separated by blanks; a comment runs from its sign to the line's
/// end. Works on memory that the caller keeps.
class TextCursor {
  public:
    /// With comment = 0 the text has no comments. A byte order mark at the start is skipped.
    TextCursor(std::string_view text, std::string path, char comment);

    /// Goes to the next line that has a word; false at the end of the text.
    bool next_line();

    /// The next word of the current line, empty at its end.
    std::string_view word();

    /// The next word on this or a later line, empty at the end of the text.
    std::string_view word_on_any_line();

    /// Passes over what is left of the current line.
    void skip_line() { rest_ = {}; }

    /// Makes a backslash at the end of a line, blanks behind it allowed, join the next line to it. It ends
    /// the word before it.
    void join_lines_at_backslash() { joins_lines_ = true; }

    /// Where the next line begins, in bytes from the start of the text.
    [[nodiscard]] std::size_t next_line_offset() const { return next_; }

    /// Of the text, counted from 1; 0 before the first.
    [[nodiscard]] std::int64_t line() const { return line_; }

    /// Throws Error(input) "PATH:LINE: sentence".
    [[noreturn]] void fail(const std::string& sentence) const;

  private:
    void take_line();

    std::string_view text_;
    std::string path_;
    char comment_;
    bool joins_lines_ = false;
    std::string_view rest_;  ///< of the current line
    std::size_t next_ = 0;
    std::int64_t line_ = 0;
};

/// The whole word as a number, its exponent behind e or, as in Fortran, d; false if it is something else.
/// Values too small for a double become 0, too large ones infinite.
bool parse_real(std::string_view word, double& value);
bool parse_integer(std::string_view word, std::int64_t& value);

/// As parse_integer, but the word may be a whole number with a point or an exponent, "3.0" or "3e+00".
bool parse_whole(std::string_view word, std::int64_t& value);

/// The word for messages, shortened and without bytes that cannot be printed.
std::string printable(std::string_view word);

/// The same in quotes.
std::string in_quotes(std::string_view word);

/// The same for a word that is no number; one with a comma is followed by what to do about it.
std::string no_number(std::string_view word);

}  // namespace coseg
