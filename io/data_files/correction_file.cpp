#include "io/data_files/correction_file.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "io/files/atomic_file.hpp"
#include "io/files/file_contents.hpp"
#include "io/files/json_failure.hpp"
#include "io/files/text_cursor.hpp"
#include "io/files/text_encoding.hpp"
#include "src/base/error.hpp"
#include "src/base/spelling.hpp"
#include "src/base/text.hpp"
#include "src/records/part_limits.hpp"

namespace coseg {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* corrections_format = "coseg corrections";
constexpr const char* constraints_format = "coseg constraints";
constexpr int corrections_version = 1;
constexpr int most_faces = 200'000'000;  // of a shape
constexpr std::size_t longest_name = 200;

[[noreturn]] void refuse_file(const std::string& sentence) { throw Error(ExitCode::input, sentence); }

std::vector<std::string_view> pieces_of(std::string_view text, char separator) {
    std::vector<std::string_view> pieces;
    while (true) {
        const std::size_t end = text.find(separator);
        pieces.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return pieces;
        text.remove_prefix(end + 1);
    }
}

/// An act while it is read: every member is asked for by name, and what nobody asked for is refused.
class ActReader {
  public:
    ActReader(const Json& act, std::string where) : act_(act), where_(std::move(where)) {
        if (!act.is_object()) refuse_file(where_ + ": an act is an object with a member \"act\"");
    }

    std::string text(const char* name) {
        const Json& value = member(name);
        if (!value.is_string()) refuse_file(where_ + ": \"" + name + "\" must be a text");
        return value.get<std::string>();
    }

    int number(const char* name, int least, int most) {
        const Json& value = member(name);
        if (!value.is_number_integer()) refuse_file(where_ + ": \"" + name + "\" must be a whole number");
        const double n = value.get<double>();
        if (n < least || n > most)
            refuse_file(where_ + ": \"" + name + "\" must be from " + std::to_string(least) + " to " +
                        std::to_string(most));
        return value.get<int>();
    }

    bool has(const char* name) const { return act_.contains(name); }
    const std::string& where() const { return where_; }

    const Json& member(const char* name) {
        const auto found = act_.find(name);
        if (found == act_.end()) refuse_file(where_ + ": \"" + name + "\" is missing");
        asked_.emplace_back(name);
        return *found;
    }

    void refuse_others() const {
        for (const auto& [name, value] : act_.items()) {
            if (std::find(asked_.begin(), asked_.end(), name) == asked_.end())
                refuse_file(where_ + ": \"" + name + "\" is no member of such an act");
        }
    }

  private:
    const Json& act_;
    std::string where_;
    std::vector<std::string> asked_;
};

/// No act is deep; a text of brackets alone would become a tree of hundreds of times its size.
Json parsed_json(std::string_view text) {
    constexpr int deepest = 16;
    return Json::parse(text, [](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
        if (depth > deepest) refuse_file("is nested more than " + std::to_string(deepest) + " deep");
        return true;
    });
}

/// JSON holds no names that are not UTF-8: their bytes stand beside them.
void set_shape(Json& json, const std::string& shape) {
    json["shape"] = shape;
    if (const auto bytes = hex_unless_utf8(shape)) json["shape_bytes"] = *bytes;
}

std::string shape_of(ActReader& act) {
    const std::string name = act.text("shape");
    return act.has("shape_bytes") ? bytes_of_hex(act.text("shape_bytes")) : name;
}

/// Adds to a message about a text where that text stands.
template <class Step>
auto in_place(const std::string& where, Step&& step) {
    try {
        return step();
    } catch (const Error& error) {
        refuse_file(where + ": " + error.what());
    }
}

CorrectedPlace place_of(ActReader& act, const char* name) {
    ActReader reader(act.member(name), act.where() + ", \"" + name + "\"");
    CorrectedPlace place;
    place.shape = shape_of(reader);
    if (reader.has("face"))
        place.face = reader.number("face", 0, most_faces);
    else if (reader.has("patch"))
        place.patch = reader.number("patch", 0, most_faces);
    else
        refuse_file(reader.where() + ": \"face\" or \"patch\" is missing");
    reader.refuse_others();
    return place;
}

std::string checked_name(const std::string& name, const std::string& where) {
    const bool has_control = std::any_of(name.begin(), name.end(), [](char c) {
        return static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) == 0x7f;
    });
    if (name.empty() || name.size() > longest_name || has_control)
        refuse_file(where + ": a name has 1 to " + std::to_string(longest_name) +
                    " bytes and no control characters");
    return name;
}

std::string checked_color(const std::string& color, const std::string& where) {
    const bool fits = color.size() == 7 && color.front() == '#' &&
                      std::all_of(color.begin() + 1, color.end(),
                                  [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; });
    if (!fits) refuse_file(where + ": a colour is written as #rrggbb");
    return color;
}

void read_label(ActReader& act, Correction& correction) {
    correction.part = act.number("part", 0, most_parts - 1);
    correction.shape = shape_of(act);
    if (!act.has("faces") && !act.has("patches"))
        refuse_file(act.where() + ": \"faces\" or \"patches\" is missing");
    for (const char* name : {"faces", "patches"}) {
        if (!act.has(name)) continue;
        const std::string text = act.text(name);
        std::vector<NumberRange> ranges =
            in_place(act.where(), [&] { return parsed_ranges(text, most_faces); });
        (std::string_view(name) == "faces" ? correction.faces : correction.patches) = std::move(ranges);
    }
}

Correction read_act(const Json& json, const std::string& where) {
    ActReader act(json, where);
    const std::string kind = act.text("act");
    const std::optional<CorrectionKind> found = named<CorrectionKind>(kind);
    if (!found) {
        const std::string meant = nearest_word(kind, names_of<CorrectionKind>());
        refuse_file(where + ": '" + kind + "' is no act" +
                    (meant.empty() ? std::string() : "; did you mean " + meant + "?"));
    }
    Correction c;
    c.kind = *found;
    c.where = where;
    const auto part = [&] { return act.number("part", 0, most_parts - 1); };
    switch (c.kind) {
        case CorrectionKind::label:
            read_label(act, c);
            break;
        case CorrectionKind::confirm: {
            c.shape = shape_of(act);
            const std::string runs = act.text("labels");
            c.labels = in_place(where, [&] { return parsed_runs(runs); });
            break;
        }
        case CorrectionKind::merge:
            c.part = part();
            c.into = act.number("into", 0, most_parts - 1);
            if (c.part == c.into) refuse_file(where + ": a part cannot be merged with itself");
            break;
        case CorrectionKind::split:
            c.part = part();
            break;
        case CorrectionKind::new_part:
            break;
        case CorrectionKind::name:
            c.part = part();
            c.text = checked_name(act.text("name"), where);
            break;
        case CorrectionKind::color:
            c.part = part();
            c.text = checked_color(act.text("color"), where);
            break;
        case CorrectionKind::absent:
            c.part = part();
            c.shape = shape_of(act);
            break;
        case CorrectionKind::must_link:
        case CorrectionKind::cannot_link:
            c.first = place_of(act, "first");
            c.second = place_of(act, "second");
            if (c.first == c.second) refuse_file(where + ": it links a place with itself");
            break;
        case CorrectionKind::level:
            c.part = act.number("parts", 2, most_parts);
            break;
    }
    act.refuse_others();
    return c;
}

Json json_of(const CorrectedPlace& place) {
    Json json;
    set_shape(json, place.shape);
    if (place.face >= 0)
        json["face"] = place.face;
    else
        json["patch"] = place.patch;
    return json;
}

Json json_of(const Correction& c) {
    Json json;
    json["act"] = to_string(c.kind);
    if (c.part >= 0) json[c.kind == CorrectionKind::level ? "parts" : "part"] = c.part;
    if (c.into >= 0) json["into"] = c.into;
    if (!c.shape.empty()) set_shape(json, c.shape);
    if (!c.faces.empty()) json["faces"] = number_ranges(c.faces);
    if (!c.patches.empty()) json["patches"] = number_ranges(c.patches);
    if (!c.labels.empty()) json["labels"] = label_runs(c.labels);
    if (!c.text.empty()) json[c.kind == CorrectionKind::name ? "name" : "color"] = c.text;
    if (c.kind == CorrectionKind::must_link || c.kind == CorrectionKind::cannot_link) {
        json["first"] = json_of(c.first);
        json["second"] = json_of(c.second);
    }
    return json;
}

Json parsed_object(const std::string& path, std::string_view bytes, const char* format) {
    Json json;
    try {
        json = parsed_json(bytes);
    } catch (const Json::exception& error) {
        refuse_file(path + ": is no JSON (" + json_failure(error) + ")");
    }
    if (!json.is_object() || !json.contains("format") || json["format"] != format)
        refuse_file(path + ": is no file of " + std::string(format).substr(6) +
                    "; its member \"format\" must be \"" + format + "\"");
    if (!json.contains("version") || json["version"] != corrections_version)
        refuse_file(path + ": is of another version than " + std::to_string(corrections_version) +
                    "; use the coseg that wrote it");
    return json;
}

std::vector<Correction> read_acts(const Json& json, const std::string& path, const char* name) {
    std::vector<Correction> acts;
    if (!json.contains(name) || !json[name].is_array())
        refuse_file(path + ": the list \"" + name + "\" is missing");
    for (const Json& act : json[name])
        acts.push_back(read_act(act, path + ", " + (std::string_view(name) == "acts" ? "act" : name) + " " +
                                         std::to_string(acts.size() + 1)));
    return acts;
}

bool is_constraint(CorrectionKind kind) {
    return kind == CorrectionKind::must_link || kind == CorrectionKind::cannot_link ||
           kind == CorrectionKind::absent || kind == CorrectionKind::name;
}

std::string trimmed(std::string_view text) {
    const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return std::string(text);
}

void skip_blanks(std::string_view& row) {
    row.remove_prefix(std::min(row.find_first_not_of(" \t"), row.size()));
}

/// What stands between two quotation marks, the first of which is the next character; doubled marks are one.
std::string take_quoted(std::string_view& row, const std::string& where) {
    std::string cell;
    while (true) {
        row.remove_prefix(1);
        const std::size_t mark = row.find('"');
        if (mark == std::string_view::npos)
            refuse_file(where + ": a cell begins with a quotation mark, but does not end with one");
        cell += row.substr(0, mark);
        row.remove_prefix(mark + 1);
        if (!row.starts_with('"')) return cell;
        cell += '"';
    }
}

/// Takes a cell off a row, up to the comma behind it.
std::string take_cell(std::string_view& row, const std::string& where) {
    skip_blanks(row);
    if (!row.starts_with('"')) {
        const std::string_view cell = row.substr(0, row.find(','));
        row.remove_prefix(cell.size());
        return trimmed(cell);
    }
    std::string cell = take_quoted(row, where);
    skip_blanks(row);
    if (row.empty() || row.front() == ',') return cell;
    refuse_file(where + ": " + in_quotes(row) +
                " follows the end of a quoted cell; write a quotation mark inside of it twice");
}

/// Source: RFC 4180. Deviates: blanks around a cell do not count, and a quoted cell ends on its line.
std::vector<std::string> csv_cells(std::string_view row, const std::string& where) {
    std::vector<std::string> cells{take_cell(row, where)};
    while (!row.empty()) {
        row.remove_prefix(1);
        cells.push_back(take_cell(row, where));
    }
    return cells;
}

int csv_number(const std::string& text, const std::string& where, int most) {
    const std::optional<int> number = whole_number(text);
    if (!number || *number < 0 || *number > most)
        refuse_file(where + ": " + in_quotes(text) + " must be a number from 0 to " + std::to_string(most));
    return *number;
}

/// kind,SHAPE,FACE,SHAPE,FACE for links; absent,PART,SHAPE; name,PART,NAME.
Correction csv_row(const std::vector<std::string>& cells, const std::string& where) {
    Correction c;
    c.where = where;
    const std::optional<CorrectionKind> kind = named<CorrectionKind>(cells.front());
    if (!kind || !is_constraint(*kind))
        refuse_file(where + ": " + in_quotes(cells.front()) +
                    " is none of must-link, cannot-link, absent and name");
    c.kind = *kind;
    const bool is_link = c.kind == CorrectionKind::must_link || c.kind == CorrectionKind::cannot_link;
    if (cells.size() != (is_link ? 5U : 3U))
        refuse_file(where + ": such a row is " + cells.front() +
                    (is_link ? ",SHAPE,FACE,SHAPE,FACE"
                             : (c.kind == CorrectionKind::name ? ",PART,NAME" : ",PART,SHAPE")));
    if (is_link) {
        c.first = {cells[1], csv_number(cells[2], where, most_faces), -1};
        c.second = {cells[3], csv_number(cells[4], where, most_faces), -1};
        if (c.first == c.second) refuse_file(where + ": it links a place with itself");
        return c;
    }
    c.part = csv_number(cells[1], where, most_parts - 1);
    if (c.kind == CorrectionKind::name)
        c.text = checked_name(cells[2], where);
    else
        c.shape = cells[2];
    return c;
}

std::vector<Correction> csv_constraints(const std::string& path, std::string_view bytes) {
    std::vector<Correction> constraints;
    int line = 0;
    for (const std::string_view row : pieces_of(bytes, '\n')) {
        ++line;
        const std::string text = trimmed(row);
        if (text.empty() || text.front() == '#') continue;
        const std::string where = path + ":" + std::to_string(line);
        constraints.push_back(csv_row(csv_cells(text, where), where));
    }
    return constraints;
}

}  // namespace

CorrectionFile read_corrections(const std::string& path) {
    const Json json = parsed_object(path, utf8_text(read_file(path)), corrections_format);
    CorrectionFile file;
    if (!json.contains("run") || !json["run"].is_string())
        refuse_file(path + ": \"run\", the hash of the run, is missing");
    file.run = json["run"].get<std::string>();
    file.acts = read_acts(json, path, "acts");
    if (json.contains("undone")) file.undone = read_acts(json, path, "undone");
    return file;
}

void write_corrections(const std::string& path, const CorrectionFile& corrections) {
    // A line an act, so that people and version control can read it.
    std::string text = "{\"format\": \"" + std::string(corrections_format) +
                       "\", \"version\": " + std::to_string(corrections_version) + ", \"run\": \"" +
                       corrections.run + "\",\n";
    const auto add = [&](const char* name, const std::vector<Correction>& acts) {
        text += "\"" + std::string(name) + "\": [";
        for (std::size_t k = 0; k < acts.size(); ++k)
            text += (k > 0 ? ",\n" : "\n") + correction_text(acts[k]);
        text += "]";
    };
    add("acts", corrections.acts);
    text += ",\n";
    add("undone", corrections.undone);
    write_file(path, text + "}\n");
}

std::vector<Correction> read_constraints(const std::string& path) {
    const std::string bytes = utf8_text(read_file(path));
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) refuse_file(path + ": there is no constraint in it");
    std::vector<Correction> constraints;
    if (bytes[first] == '{')
        constraints = read_acts(parsed_object(path, bytes, constraints_format), path, "constraints");
    else
        constraints = csv_constraints(path, bytes);
    for (const Correction& c : constraints) {
        if (!is_constraint(c.kind))
            refuse_file(c.where + ": " + to_string(c.kind) +
                        " is no constraint; these are must-link, cannot-link, absent and name");
    }
    if (constraints.empty()) refuse_file(path + ": there is no constraint in it");
    return constraints;
}

Correction parsed_correction(std::string_view json, const std::string& where) {
    Json parsed;
    try {
        parsed = parsed_json(json);
    } catch (const Json::exception& error) {
        refuse_file(where + ": is no JSON (" + json_failure(error) + ")");
    }
    return read_act(parsed, where);
}

std::string correction_text(const Correction& correction) {
    return json_of(correction).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string summary_of(const Correction& c) {
    const auto place = [](const CorrectedPlace& p) {
        return (p.face >= 0 ? "face " + std::to_string(p.face) : "patch " + std::to_string(p.patch)) +
               " of " + p.shape;
    };
    const std::string part = "part " + std::to_string(c.part);
    switch (c.kind) {
        case CorrectionKind::label:
            return "label " + part + " in " + c.shape;
        case CorrectionKind::confirm:
            return "confirm " + c.shape;
        case CorrectionKind::merge:
            return "merge " + part + " into part " + std::to_string(c.into);
        case CorrectionKind::split:
            return "split " + part;
        case CorrectionKind::new_part:
            return "new part";
        case CorrectionKind::name:
            return "name " + part + " '" + c.text + "'";
        case CorrectionKind::color:
            return "show " + part + " in " + c.text;
        case CorrectionKind::absent:
            return part + " absent in " + c.shape;
        case CorrectionKind::must_link:
            return "must-link " + place(c.first) + " and " + place(c.second);
        case CorrectionKind::cannot_link:
            return "cannot-link " + place(c.first) + " and " + place(c.second);
        case CorrectionKind::level:
            return "level of " + std::to_string(c.part) + " parts";
    }
    return "";
}

std::string number_ranges(const std::vector<NumberRange>& ranges) {
    std::string text;
    for (const NumberRange& range : ranges) {
        text += (text.empty() ? "" : ",") + std::to_string(range.first);
        if (range.last > range.first) text += "-" + std::to_string(range.last);
    }
    return text;
}

std::vector<NumberRange> parsed_ranges(std::string_view text, int most) {
    std::vector<NumberRange> ranges;
    for (const std::string_view piece : pieces_of(text, ',')) {
        const std::size_t dash = piece.find('-');
        const std::optional<int> first = whole_number(piece.substr(0, dash));
        const std::optional<int> last =
            dash == std::string_view::npos ? first : whole_number(piece.substr(dash + 1));
        if (!first || !last || *first < 0 || *last < *first || *last > most)
            refuse_file("'" + std::string(piece) + "' is no number or range of numbers such as 0-11");
        if (!ranges.empty() && *first <= ranges.back().last)
            refuse_file("'" + std::string(piece) + "' does not ascend");
        if (!ranges.empty() && *first == ranges.back().last + 1)
            ranges.back().last = *last;
        else
            ranges.push_back({*first, *last});
    }
    return ranges;
}

std::string label_runs(const std::vector<LabelRun>& runs) {
    std::string text;
    for (const LabelRun& run : runs) {
        text += (text.empty() ? "" : ",") + std::to_string(run.label);
        if (run.count > 1) text += "*" + std::to_string(run.count);
    }
    return text;
}

std::vector<LabelRun> parsed_runs(std::string_view text) {
    std::vector<LabelRun> runs;
    std::int64_t total = 0;
    for (const std::string_view piece : pieces_of(text, ',')) {
        const std::size_t star = piece.find('*');
        const std::optional<int> label = whole_number(piece.substr(0, star));
        const std::optional<int> count =
            star == std::string_view::npos ? std::optional<int>(1) : whole_number(piece.substr(star + 1));
        if (!label || !count || *label < 0 || *label >= most_parts || *count < 1 ||
            *count > most_faces - total)
            refuse_file("'" + std::string(piece) + "' is no run of labels such as 2*12");
        total += *count;
        runs.push_back({*label, *count});
    }
    return runs;
}

}  // namespace coseg
