#include "io/mesh_files/vtk_array.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <type_traits>

#include "io/files/base64.hpp"
#include "io/files/byte_cursor.hpp"
#include "io/files/text_cursor.hpp"
#include "src/base/error.hpp"

namespace coseg {

namespace {

[[noreturn]] void fail_vtk(const VtkArray& array, const std::string& path, const std::string& sentence) {
    throw Error(ExitCode::input, path + ": the array " + array.what + " " + sentence);
}

constexpr const char* cut_short = "is cut short; export the mesh again";

/// Bytes as they are or as base64, in which bytes that were written at once begin with a character of their
/// own.
class EncodedBytes {
  public:
    EncodedBytes(std::string_view text, bool is_base64) : text_(text), is_base64_(is_base64) {}

    /// The next `count` bytes, which are or begin what was written at once; nothing if fewer are there.
    [[nodiscard]] std::optional<std::string> peek(std::uint64_t count) const {
        if (count > text_.size() || length_of(count) > text_.size()) return std::nullopt;
        const std::string_view encoded = text_.substr(0, length_of(count));
        if (!is_base64_) return std::string(encoded);
        const std::optional<std::vector<char>> bytes = bytes_of_base64(encoded);
        if (!bytes || bytes->size() < count) return std::nullopt;
        return std::string(bytes->data(), static_cast<std::size_t>(count));
    }

    /// The same for all that was written at once, which is then behind us.
    std::optional<std::string> take(std::uint64_t count) {
        std::optional<std::string> bytes = peek(count);
        if (bytes) text_.remove_prefix(length_of(count));
        return bytes;
    }

    /// More bytes than are left.
    [[nodiscard]] std::uint64_t most_left() const { return text_.size(); }

  private:
    [[nodiscard]] std::size_t length_of(std::uint64_t count) const {
        return static_cast<std::size_t>(is_base64_ ? (count + 2) / 3 * 4 : count);
    }

    std::string_view text_;
    bool is_base64_;
};

/// Lengths at the beginning of an array.
std::vector<std::uint64_t> lengths_of(const std::string& bytes, const VtkEncoding& encoding) {
    std::vector<std::uint64_t> lengths;
    ByteCursor cursor(bytes, 0, encoding.is_big_endian);
    while (cursor.left() > 0) {
        std::uint64_t length = 0;
        std::uint32_t short_length = 0;
        if (encoding.has_long_headers ? !cursor.read(length) : !cursor.read(short_length)) break;
        lengths.push_back(encoding.has_long_headers ? length : short_length);
    }
    return lengths;
}

/// The bytes of an array that is compressed in blocks: their number, the length of a whole one and that of
/// the last one (0: it is whole too), and the lengths of all when compressed, before the blocks themselves.
class CompressedBlocks {
  public:
    CompressedBlocks(const VtkArray& array, const VtkEncoding& encoding, const std::string& path)
        : array_(array), encoding_(encoding), path_(path) {}

    std::string bytes_of(EncodedBytes source) const {
        const std::uint64_t word = encoding_.has_long_headers ? 8 : 4;
        const std::vector<std::uint64_t> sizes = header_of(source.peek(3 * word));
        if (sizes[0] == 0) return {};
        if (sizes[0] > source.most_left()) fail_vtk(array_, path_, cut_short);
        const std::vector<std::uint64_t> lengths = header_of(source.take((3 + sizes[0]) * word));
        std::uint64_t total = 0;
        for (std::size_t k = 3; k < lengths.size(); ++k) {
            if (lengths[k] > source.most_left() - total) fail_vtk(array_, path_, cut_short);
            total += lengths[k];
        }
        const std::optional<std::string> blocks = source.take(total);
        if (!blocks) fail_vtk(array_, path_, cut_short);
        std::string bytes;
        std::string_view left = *blocks;
        for (std::size_t k = 3; k < lengths.size(); ++k) {
            const bool is_shorter = k + 1 == lengths.size() && sizes[2] > 0;
            append_block(bytes, left.substr(0, static_cast<std::size_t>(lengths[k])),
                         sizes[is_shorter ? 2 : 1]);
            left.remove_prefix(static_cast<std::size_t>(lengths[k]));
        }
        return bytes;
    }

  private:
    [[nodiscard]] std::vector<std::uint64_t> header_of(const std::optional<std::string>& bytes) const {
        if (!bytes) fail_vtk(array_, path_, cut_short);
        return lengths_of(*bytes, encoding_);
    }

    void append_block(std::string& bytes, std::string_view block, std::uint64_t size) const {
        constexpr std::uint64_t most_growth = 1032;  // of what zlib compresses
        if (size > most_growth * block.size() + 64)
            fail_vtk(array_, path_,
                     "promises more than its compressed blocks can hold; export the mesh again");
        const std::size_t begin = bytes.size();
        bytes.resize(begin + static_cast<std::size_t>(size));
        uLongf found = size;
        const int outcome = uncompress(reinterpret_cast<Bytef*>(bytes.data() + begin), &found,
                                       reinterpret_cast<const Bytef*>(block.data()), block.size());
        if (outcome != Z_OK || found != size)
            fail_vtk(array_, path_, "has a damaged compressed block; export the mesh again");
    }

    const VtkArray& array_;
    const VtkEncoding& encoding_;
    const std::string& path_;
};

void refuse_other_compressors(const VtkArray& array, const VtkEncoding& encoding, const std::string& path) {
    if (encoding.compressor.empty() || encoding.compressor == "vtkZLibDataCompressor") return;
    fail_vtk(array, path,
             "is compressed by " + in_quotes(encoding.compressor) +
                 ", of which only vtkZLibDataCompressor is read; save the mesh uncompressed");
}

std::string bytes_of(const VtkArray& array, const VtkEncoding& encoding, const std::string& path) {
    refuse_other_compressors(array, encoding, path);
    const bool is_appended = array.format == "appended";
    std::string inline_text;
    std::string_view text = encoding.appended;
    if (is_appended) {
        std::int64_t offset = 0;
        if (!parse_integer(array.offset, offset) || offset < 0)
            fail_vtk(array, path, "has the offset " + in_quotes(array.offset) + "; export the mesh again");
        if (static_cast<std::uint64_t>(offset) > text.size()) fail_vtk(array, path, cut_short);
        text.remove_prefix(static_cast<std::size_t>(offset));
    } else {
        std::copy_if(array.text.begin(), array.text.end(), std::back_inserter(inline_text),
                     [](char c) { return c != ' ' && c != '\t' && c != '\r' && c != '\n'; });
        text = inline_text;
    }
    EncodedBytes source(text, !is_appended || encoding.has_base64_appended);
    if (!encoding.compressor.empty()) return CompressedBlocks(array, encoding, path).bytes_of(source);
    const std::uint64_t word = encoding.has_long_headers ? 8 : 4;
    const std::optional<std::string> header = source.peek(word);
    const std::uint64_t length = header ? lengths_of(*header, encoding).front() : 0;
    if (!header || length > source.most_left()) fail_vtk(array, path, cut_short);
    std::optional<std::string> bytes = source.take(word + length);
    if (!bytes) fail_vtk(array, path, cut_short);
    return bytes->substr(static_cast<std::size_t>(word));
}

template <class Number, class Raw>
std::vector<Number> numbers_as(const std::string& bytes, const VtkArray& array, const VtkEncoding& encoding,
                               const std::string& path) {
    if (bytes.size() % sizeof(Raw) != 0) fail_vtk(array, path, cut_short);
    std::vector<Number> numbers;
    numbers.reserve(bytes.size() / sizeof(Raw));
    ByteCursor cursor(bytes, 0, encoding.is_big_endian);
    for (Raw raw{}; cursor.read(raw);) numbers.push_back(static_cast<Number>(raw));
    return numbers;
}

template <class Number>
using Decoder = std::vector<Number> (*)(const std::string&, const VtkArray&, const VtkEncoding&,
                                        const std::string&);

template <class Number>
Decoder<Number> decoder_of(std::string_view type) {
    if (type == "Int8") return numbers_as<Number, std::int8_t>;
    if (type == "UInt8") return numbers_as<Number, std::uint8_t>;
    if (type == "Int16") return numbers_as<Number, std::int16_t>;
    if (type == "UInt16") return numbers_as<Number, std::uint16_t>;
    if (type == "Int32") return numbers_as<Number, std::int32_t>;
    if (type == "UInt32") return numbers_as<Number, std::uint32_t>;
    if (type == "Int64") return numbers_as<Number, std::int64_t>;
    if (type == "UInt64") return numbers_as<Number, std::uint64_t>;
    if constexpr (std::is_same_v<Number, double>) {
        if (type == "Float32") return numbers_as<double, float>;
        if (type == "Float64") return numbers_as<double, double>;
    }
    return nullptr;
}

bool parse_number(std::string_view word, double& number) { return parse_real(word, number); }
bool parse_number(std::string_view word, std::int64_t& number) { return parse_integer(word, number); }

template <class Number>
std::vector<Number> numbers_of_text(const VtkArray& array, const std::string& path) {
    std::vector<Number> numbers;
    TextCursor words(array.text, path, 0);
    for (std::string_view word = words.word_on_any_line(); !word.empty(); word = words.word_on_any_line()) {
        Number number{};
        if (!parse_number(word, number))
            fail_vtk(array, path,
                     "has the value " + no_number(word) + " in place " + std::to_string(numbers.size()) +
                         " (counted from 0)");
        numbers.push_back(number);
    }
    return numbers;
}

template <class Number>
std::vector<Number> numbers_of(const VtkArray& array, const VtkEncoding& encoding, const std::string& path) {
    const Decoder<Number> decode = decoder_of<Number>(array.type);
    if (decode == nullptr)
        fail_vtk(array, path, "is of the type " + in_quotes(array.type) + ", which cannot be used there");
    if (array.format == "ascii") return numbers_of_text<Number>(array, path);
    if (array.format == "binary" || array.format == "appended")
        return decode(bytes_of(array, encoding, path), array, encoding, path);
    fail_vtk(array, path,
             "has the format " + in_quotes(array.format) +
                 ", not ascii, binary or appended; export the mesh again");
}

}  // namespace

std::vector<double> vtk_reals(const VtkArray& array, const VtkEncoding& encoding, const std::string& path) {
    return numbers_of<double>(array, encoding, path);
}

std::vector<std::int64_t> vtk_integers(const VtkArray& array, const VtkEncoding& encoding,
                                       const std::string& path) {
    return numbers_of<std::int64_t>(array, encoding, path);
}

}  // namespace coseg
