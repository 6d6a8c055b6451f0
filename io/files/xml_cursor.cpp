#include "io/files/xml_cursor.hpp"

#include <expat.h>

#include <algorithm>
#include <exception>
#include <new>

#include "src/base/error.hpp"

namespace coseg {

std::string_view XmlTag::attribute(std::string_view wanted, std::string_view otherwise) const {
    for (const auto& [key, value] : attributes) {
        if (key == wanted) return value;
    }
    return otherwise;
}

/// Expat, which is stopped at every tag and goes on when the next one is asked for.
class XmlCursor::Parser {
  public:
    explicit Parser(std::string_view text) : text_(text), expat_(XML_ParserCreate(nullptr)) {
        if (expat_ == nullptr) throw std::bad_alloc();
        XML_SetUserData(expat_, this);
        XML_SetElementHandler(expat_, begin_of_element, end_of_element);
        XML_SetCommentHandler(expat_, [](void* parser, const char*) { of(parser).pass_over(); });
        XML_SetProcessingInstructionHandler(
            expat_, [](void* parser, const char*, const char*) { of(parser).pass_over(); });
        XML_SetStartDoctypeDeclHandler(
            expat_, [](void* parser, const char*, const char*, const char*, int) { of(parser).refuse(); });
    }
    ~Parser() { XML_ParserFree(expat_); }
    Parser(const Parser&) = delete;
    Parser& operator=(const Parser&) = delete;

    /// Goes on until a tag has been found or there is none.
    std::optional<XmlTag> run() {
        found_.reset();
        while (!found_) {
            if (status_ == XML_STATUS_OK && was_given_all_) return std::nullopt;
            status_ = status_ == XML_STATUS_SUSPENDED ? XML_ResumeParser(expat_) : parse_more();
            if (exception_) std::rethrow_exception(exception_);
            if (status_ == XML_STATUS_ERROR) return std::nullopt;
        }
        return std::move(found_);
    }

    /// What is wrong with the text at tag(); nothing if it is XML as far as it was read.
    [[nodiscard]] std::optional<std::string> fault() {
        if (status_ != XML_STATUS_ERROR) return std::nullopt;
        const XML_Index place = XML_GetCurrentByteIndex(expat_);
        if (place >= 0) tag_ = static_cast<std::size_t>(place);
        if (is_declared_) return "declarations of XML ('<!') are not read";
        switch (XML_GetErrorCode(expat_)) {
            case XML_ERROR_NO_ELEMENTS:
            case XML_ERROR_UNCLOSED_TOKEN:
            case XML_ERROR_UNCLOSED_CDATA_SECTION:
            case XML_ERROR_PARTIAL_CHAR:
                return "the XML is cut short";
            default:
                return "the XML is damaged (" + std::string(XML_ErrorString(XML_GetErrorCode(expat_))) + ")";
        }
    }

    [[nodiscard]] std::string_view text() const { return text_; }
    [[nodiscard]] std::string_view text_before() const { return text_before_; }
    [[nodiscard]] std::size_t tag() const { return tag_; }
    [[nodiscard]] std::size_t next() const { return next_; }

  private:
    static Parser& of(void* parser) { return *static_cast<Parser*>(parser); }

    /// Expat counts bytes in int.
    XML_Status parse_more() {
        constexpr std::size_t most = std::size_t{1} << 30;
        const std::string_view part = text_.substr(given_, most);
        given_ += part.size();
        was_given_all_ = given_ == text_.size();
        return XML_Parse(expat_, part.data(), static_cast<int>(part.size()), was_given_all_ ? 1 : 0);
    }

    /// An exception must not pass through the C code of Expat: it is thrown again behind it.
    template <class Step>
    void guarded(Step&& step) noexcept {
        try {
            step();
        } catch (...) {
            exception_ = std::current_exception();
            XML_StopParser(expat_, XML_FALSE);
        }
    }

    void pass_over() noexcept {
        tag_ = static_cast<std::size_t>(XML_GetCurrentByteIndex(expat_));
        next_ = tag_ + static_cast<std::size_t>(XML_GetCurrentByteCount(expat_));
    }

    void refuse() noexcept {
        is_declared_ = true;
        XML_StopParser(expat_, XML_FALSE);
    }

    void stop_at(XmlTag tag) {
        const std::size_t before = next_;
        pass_over();
        text_before_ = text_.substr(before, tag_ - before);
        found_ = std::move(tag);
        XML_StopParser(expat_, XML_TRUE);
    }

    static void begin_of_element(void* parser, const char* name, const char** attributes) {
        of(parser).guarded([&] {
            XmlTag tag{name, true, false};
            for (; *attributes != nullptr; attributes += 2)
                tag.attributes.emplace_back(attributes[0], attributes[1]);
            of(parser).stop_at(std::move(tag));
        });
    }

    /// The end of <a/> comes at once, although Expat has been stopped at its begin.
    static void end_of_element(void* parser, const char* name) {
        Parser& self = of(parser);
        if (self.found_)
            self.found_->ends = true;
        else
            self.guarded([&] { self.stop_at({name, false, true}); });
    }

    std::string_view text_;
    XML_Parser expat_;
    XML_Status status_ = XML_STATUS_OK;
    std::size_t given_ = 0;  ///< bytes of the text that Expat has got
    bool was_given_all_ = false;
    bool is_declared_ = false;
    std::exception_ptr exception_;
    std::optional<XmlTag> found_;
    std::string_view text_before_;
    std::size_t tag_ = 0;   ///< where the last tag begins
    std::size_t next_ = 0;  ///< where the text behind it begins
};

XmlCursor::XmlCursor(std::string_view text, std::string path)
    : parser_(std::make_unique<Parser>(text)), path_(std::move(path)) {}

XmlCursor::~XmlCursor() = default;

std::optional<XmlTag> XmlCursor::next_tag() {
    std::optional<XmlTag> tag = parser_->run();
    if (const std::optional<std::string> fault = parser_->fault()) fail(*fault + "; export the mesh again");
    return tag;
}

std::string_view XmlCursor::text_before_tag() const { return parser_->text_before(); }

std::string_view XmlCursor::rest() const { return parser_->text().substr(parser_->next()); }

void XmlCursor::fail(const std::string& sentence) const {
    const std::string_view before = parser_->text().substr(0, parser_->tag());
    throw Error(
        ExitCode::input,
        path_ + ":" + std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ": " + sentence);
}

}  // namespace coseg
