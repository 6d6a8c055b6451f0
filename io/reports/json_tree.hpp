#pragma once
// Makes a JSON text. The header does not need the library that makes it.

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace coseg {

/// A place in a tree: what is set there replaces what was. Fill one place before the next one is asked for; a
/// place is lost when its parent gets another member or element.
class JsonPlace {
  public:
    explicit JsonPlace(void* value) : value_(value) {}

    /// The member of an object; becomes an object if it was nothing.
    [[nodiscard]] JsonPlace member(std::string_view name) const;
    /// A new last element of an array.
    [[nodiscard]] JsonPlace element() const;

    void set_object() const;
    void set_array() const;
    void set_null() const;
    void set(bool value) const;
    void set(std::int64_t value) const;
    void set(std::uint64_t value) const;
    /// Sets the number; null where it is not finite, which JSON cannot express.
    void set(double value) const;
    void set(std::string_view text) const;
    /// A literal, which would otherwise become a truth value.
    void set(const char* text) const { set(std::string_view(text)); }
    /// Sets the number or the truth value that the text spells, else the text.
    void set_typed(const std::string& text) const;

  private:
    void* value_;
};

/// Owns a tree. Members keep the order in which they were made.
class JsonTree {
  public:
    JsonTree();
    ~JsonTree();
    JsonTree(const JsonTree&) = delete;
    JsonTree& operator=(const JsonTree&) = delete;

    [[nodiscard]] JsonPlace root();
    /// In one line, or over several, indented by two blanks. What is not UTF-8 is replaced.
    [[nodiscard]] std::string line() const;
    [[nodiscard]] std::string pretty() const;

  private:
    struct Value;
    std::unique_ptr<Value> value_;
};

}  // namespace coseg
