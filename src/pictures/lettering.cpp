#include "src/pictures/lettering.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "src/base/index.hpp"

namespace coseg {

namespace {

// The letters of ASCII 33..126 as pen strokes: strokes are parted by blanks, each is a list of points, two
// digits a point: x, and y upwards with the descender at 0, the baseline at 2, small letters up to 6,
// capitals up to 8. A stroke that begins with ~ is rounded.
constexpr std::array<std::string_view, 94> letters = {
    /* ! " # $ % */ "0804 0202",
    "0806 2826",
    "1218 3238 0444 0646",
    "~4748080545420203 2921",
    "0248 ~180806262818 ~342422424434",
    /* & ' ( ) * */ "~420608282603023245",
    "0806",
    "~280520",
    "~082500",
    "1715 0645 0546 2428",
    /* + , - . / */ "0545 2327",
    "1201",
    "0535",
    "0202",
    "0038",
    /* 0 1 2 3 4 */ "~280802424828 25",
    "062822",
    "~0608484502 0242",
    "~0708484525 ~2545420203",
    "32380444",
    /* 5 6 7 8 9 */ "480806 ~0646420203",
    "~38080242460604",
    "084812",
    "~280805454828 ~250502424525",
    "~12424808044446",
    /* : ; < = > */ "0505 0202",
    "0505 1201",
    "460543",
    "0444 0646",
    "064503",
    /* ? @ A */ "~070848452524 2222",
    "~42020848443436 ~36161434",
    "022842 1434",
    /* B C D E F */ "0208 ~08383505 ~05454202",
    "~474808024243",
    "0208 ~08484202",
    "48080242 0535",
    "480802 0535",
    /* G H I J K */ "~474808024244 4424",
    "0208 4248 0545",
    "0802",
    "~38320203",
    "0208 480542 1642",
    /* L M N O P */ "080242",
    "0208234842",
    "02084248",
    "~280802424828",
    "0208 ~08484505",
    /* Q R S T U */ "~280802424828 2441",
    "0208 ~08484505 2542",
    "~4748080545420203",
    "0848 2822",
    "~080402424448",
    /* V W X Y Z */ "082248",
    "0812385268",
    "0248 0842",
    "082548 2522",
    "08480242",
    /* [ \ ] ^ _ */ "28080020",
    "0830",
    "08282000",
    "062846",
    "0141",
    /* ` a b c d e */ "0817",
    "4642 ~444606024244",
    "0802 ~040646420204",
    "~454606024243",
    "4842 ~444606024244",
    "0444 ~4446060242",
    /* f g h i j */ "~381814 1412 0636",
    "~444606024244 ~4643400001",
    "0802 ~0406464442",
    "0602 0808",
    "~16131000 1818",
    /* k l m n o */ "0802 460442",
    "~080212",
    "0602 ~0406363432 ~3436666462",
    "0602 ~0406464442",
    "~260602424626",
    /* p q r s t */ "0600 ~040646420204",
    "4640 ~444606024244",
    "0602 ~040636",
    "~4546060444420203",
    "~18141232 0636",
    /* u v w x y */ "~0604024244 4642",
    "062246",
    "0612365266",
    "0246 0642",
    "0622 4610",
    /* z { | } ~ */ "06460242",
    "~281805 ~051020",
    "0800",
    "~081825 ~251000",
    "~04163446"};

constexpr double top_of_capitals = 8.0;
constexpr double baseline = 2.0;
constexpr double gap = 1.9;         // between letters
constexpr double blank = 2.6;       // a space's advance
constexpr double pen = 0.78;        // width of a stroke
constexpr double narrowing = 0.82;  // of the grid's width

using Stroke = std::vector<Eigen::Vector2d>;

std::vector<Stroke> parsed(std::string_view text) {
    std::vector<Stroke> strokes(1);
    bool is_round = false;
    const auto finish = [&] {
        Stroke& stroke = strokes.back();
        for (int round = 0; is_round && round < 3; ++round) {  // Chaikin's corner cutting; the ends stay
            Stroke finer = {stroke.front()};
            for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
                finer.emplace_back(0.75 * stroke[i] + 0.25 * stroke[i + 1]);
                finer.emplace_back(0.25 * stroke[i] + 0.75 * stroke[i + 1]);
            }
            finer.push_back(stroke.back());
            stroke = finer;
        }
        is_round = false;
    };
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == ' ') {
            finish();
            strokes.emplace_back();
            ++i;
        } else if (text[i] == '~') {
            is_round = true;
            ++i;
        } else if (i + 1 < text.size() && text[i + 1] != ' ') {
            strokes.back().emplace_back(narrowing * (text[i] - '0'), text[i + 1] - '0');
            i += 2;
        } else {
            ++i;
        }
    }
    finish();
    std::erase_if(strokes, [](const Stroke& stroke) { return stroke.empty(); });
    return strokes;
}

struct Glyph {
    std::vector<Stroke> strokes;
    double advance = blank;
};

Glyph made_glyph(std::string_view text) {
    Glyph glyph{parsed(text), 0.0};
    for (const Stroke& stroke : glyph.strokes) {
        for (const Eigen::Vector2d& point : stroke) glyph.advance = std::max(glyph.advance, point.x());
    }
    glyph.advance += gap;
    return glyph;
}

const Glyph& glyph_of(char letter) {
    static const std::vector<Glyph> glyphs = [] {
        std::vector<Glyph> made;
        for (const std::string_view text : letters) made.push_back(made_glyph(text));
        made.push_back(made_glyph("0248 0208484202 0842"));  // a box for what has no letter
        return made;
    }();
    static const Glyph space;
    if (letter == ' ') return space;
    const int index = letter - 33;
    const bool is_known = index >= 0 && index < static_cast<int>(letters.size());
    return glyphs[is_known ? at(index) : letters.size()];
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d along = b - a;
    const double length = along.squaredNorm();
    const double t = length > 0.0 ? std::clamp((p - a).dot(along) / length, 0.0, 1.0) : 0.0;
    return (p - a - t * along).norm();
}

double distance_to_glyph(const Eigen::Vector2d& p, const Glyph& glyph) {
    double least = 1e9;
    for (const Stroke& stroke : glyph.strokes) {
        for (std::size_t i = 0; i + 1 < stroke.size() || i == 0; ++i) {
            const Eigen::Vector2d& next = stroke[std::min(i + 1, stroke.size() - 1)];
            least = std::min(least, distance_to_segment(p, stroke[i], next));
        }
    }
    return least;
}

double unit_of(double height) { return height / (top_of_capitals - baseline); }

}  // namespace

void draw_text(Image& image, double x, double y, const std::string& text, double height, const Color& color) {
    const double unit = unit_of(height);
    const double half_pen = std::max(0.5 * pen * unit, 0.45);
    double left = x;
    for (const char letter : text) {
        const Glyph& glyph = glyph_of(letter);
        const double right = left + (glyph.advance + 1.0) * unit;
        for (int row = static_cast<int>(y - height) - 3; row <= static_cast<int>(y + 2.0 * unit) + 3; ++row) {
            for (int column = static_cast<int>(left) - 2; column <= static_cast<int>(right); ++column) {
                const Eigen::Vector2d point((column + 0.5 - left) / unit, baseline + (y - row - 0.5) / unit);
                const double away = distance_to_glyph(point, glyph) * unit;
                blend(image, column, row, color, std::clamp(half_pen + 0.5 - away, 0.0, 1.0));
            }
        }
        left += glyph.advance * unit;
    }
}

double text_width(const std::string& text, double height) {
    double width = 0.0;
    for (const char letter : text) width += glyph_of(letter).advance;
    return text.empty() ? 0.0 : (width - gap) * unit_of(height);
}

std::string shortened_text(const std::string& text, double height, double width) {
    if (text_width(text, height) <= width) return text;
    for (std::size_t kept = text.size(); kept > 0; --kept) {
        std::string shorter = text.substr(0, (kept + 1) / 2) + ".." + text.substr(text.size() - kept / 2);
        if (text_width(shorter, height) <= width) return shorter;
    }
    return "";
}

}  // namespace coseg
