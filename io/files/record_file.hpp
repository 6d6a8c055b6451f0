#pragma once
// Records in HDF5 files. One record: its numbers, truth values and texts are attributes of the root, the rest
// are datasets, all named PATH/FIELD. Many records: one dataset a field, with a row for each record.
//
// How a column of values is kept, where NAME is its path: numbers as they are, truth values and enumerations
// as small integers, texts as texts; vectors as the lengths in NAME/count and all elements in NAME/value;
// matrices likewise with NAME/rows and NAME/columns, their entries column by column; arrays as rows of a
// fixed length; an optional value as a vector of none or one.

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "io/files/hdf5_file.hpp"
#include "io/files/number_text.hpp"
#include "src/base/enum_names.hpp"
#include "src/base/error.hpp"
#include "src/records/fields.hpp"

namespace coseg {

template <class T>
std::vector<T> read_column(const Hdf5Reader& file, const std::string& name);

namespace record_file {

template <class R, class T>
std::string path_of(const std::string& path, const Field<R, T>& entry) {
    const std::string name = entry.name;
    if (path.empty() || name.empty()) return path + name;
    return path + "/" + name;
}

/// The type of a scalar in a file.
template <class T>
auto kept(T value) {
    if constexpr (std::is_floating_point_v<T>) {
        return value;
    } else if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T>) {
        return static_cast<std::int8_t>(value);
    } else if constexpr (sizeof(T) == 8) {
        return static_cast<std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>>(value);
    } else {
        static_assert(sizeof(T) <= 4, "an integer of 8, 16, 32 or 64 bits");
        return static_cast<std::int32_t>(value);
    }
}
template <class T>
using Kept = decltype(kept(std::declval<T>()));

/// The values of a column by reference. They are copied once, into what the library writes.
template <class T>
using Places = std::vector<const T*>;

template <class T>
void write_places(Hdf5Writer& file, const std::string& name, const Places<T>& values, Storage storage);

template <class T, class Range>
void write_scalars(Hdf5Writer& file, const std::string& name, const Range& values, Hdf5Shape shape,
                   Storage storage) {
    const bool compressed = storage == Storage::compressed;
    if constexpr (std::is_same_v<T, Kept<T>>) {
        file.write(name, std::span<const T>(values), std::move(shape), compressed);
    } else {
        std::vector<Kept<T>> numbers;
        numbers.reserve(values.size());
        for (const T value : values) numbers.push_back(kept(value));
        file.write(name, numbers, std::move(shape), compressed);
    }
}

/// Whether a number of a file is that of a value of T: a truth value is 0 or 1, an enumerator has a name, and
/// a number is not beyond those of T. Unsigned numbers as wide as the file's own may stand there with a sign.
template <class T, class Number>
bool stands_for_value(Number number) {
    if constexpr (std::is_same_v<T, bool>) {
        return number == 0 || number == 1;
    } else if constexpr (std::is_enum_v<T>) {
        return std::in_range<std::underlying_type_t<T>>(number) && !name_of(static_cast<T>(number)).empty();
    } else if constexpr (std::is_floating_point_v<T>) {
        return !std::isfinite(number) || std::abs(number) <= Number{std::numeric_limits<T>::max()};
    } else {
        return sizeof(T) == sizeof(Number) || std::in_range<T>(number);
    }
}

/// The value for which a number of the file stands. Throws Error(input) where it stands for none.
template <class T, class Number>
T value_of(const Hdf5Reader& file, const std::string& name, Number number) {
    if (stands_for_value<T>(number)) return static_cast<T>(number);
    std::string text;
    append_number(text, number, ',');
    throw Error(ExitCode::input,
                file.path() + ": '" + name + "' holds " + text + " which stands for nothing");
}

template <class T>
std::vector<T> read_scalars(const Hdf5Reader& file, const std::string& name) {
    auto numbers = file.read<Kept<T>>(name);
    if constexpr (std::is_same_v<T, Kept<T>>) {
        return numbers;
    } else {
        std::vector<T> values;
        for (const auto number : numbers) values.push_back(value_of<T>(file, name, number));
        return values;
    }
}

[[noreturn]] inline void refuse_lengths(const Hdf5Reader& file, const std::string& name) {
    throw Error(ExitCode::input, file.path() + ": the parts of '" + name + "' do not fit together");
}

/// Calls visit(element) for the elements of a vector, of an array or of an optional value.
template <class Container, class Visit>
void for_each_element(const Container& container, Visit&& visit) {
    if constexpr (kinds::is_optional<Container>) {
        if (container) visit(*container);
    } else {
        for (const auto& element : container) visit(element);
    }
}

/// Elements of several containers one after the other.
template <class Container>
void write_elements(Hdf5Writer& file, const std::string& name, const Places<Container>& containers,
                    Hdf5Shape shape, Storage storage) {
    using T = typename Container::value_type;
    if constexpr (Scalar<T>) {
        std::vector<Kept<T>> flat;
        for (const Container* container : containers)
            for_each_element(*container, [&](const T& value) { flat.push_back(kept(value)); });
        file.write(name, flat, std::move(shape), storage == Storage::compressed);
    } else {
        Places<T> flat;
        for (const Container* container : containers)
            for_each_element(*container, [&](const T& value) { flat.push_back(&value); });
        write_places(file, name, flat, storage);
    }
}

template <class Container>
std::vector<std::int64_t> counts_of(const Places<Container>& containers) {
    std::vector<std::int64_t> counts;
    for (const Container* container : containers) {
        if constexpr (kinds::is_optional<Container>) {
            counts.push_back(*container ? 1 : 0);
        } else {
            counts.push_back(static_cast<std::int64_t>(container->size()));
        }
    }
    return counts;
}

template <class Container>
std::vector<Container> parted(const Hdf5Reader& file, const std::string& name) {
    using T = typename Container::value_type;
    const auto counts = read_column<std::int64_t>(file, name + "/count");
    const auto flat = read_column<T>(file, name + "/value");
    std::vector<Container> containers(counts.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
        const auto count = static_cast<std::size_t>(counts[k]);
        if (counts[k] < 0 || count > flat.size() - next) refuse_lengths(file, name);
        const auto first = flat.begin() + static_cast<std::ptrdiff_t>(next);
        if constexpr (kinds::is_optional<Container>) {
            if (count > 0) containers[k] = *first;
        } else {
            containers[k].assign(first, first + static_cast<std::ptrdiff_t>(count));
        }
        next += count;
    }
    return containers;
}

template <class M>
void write_matrices(Hdf5Writer& file, const std::string& name, const Places<M>& matrices, Storage storage) {
    std::vector<std::int64_t> rows;
    std::vector<std::int64_t> columns;
    std::vector<typename M::Scalar> entries;
    for (const M* matrix : matrices) {
        rows.push_back(matrix->rows());
        columns.push_back(matrix->cols());
        entries.insert(entries.end(), matrix->data(), matrix->data() + matrix->size());
    }
    file.write(name + "/rows", rows);
    file.write(name + "/columns", columns);
    write_scalars<typename M::Scalar>(file, name + "/value", entries, {}, storage);
}

template <class M>
std::vector<M> read_matrices(const Hdf5Reader& file, const std::string& name) {
    const auto rows = file.read<std::int64_t>(name + "/rows");
    const auto columns = file.read<std::int64_t>(name + "/columns");
    const auto entries = read_scalars<typename M::Scalar>(file, name + "/value");
    if (rows.size() != columns.size()) refuse_lengths(file, name);
    std::vector<M> matrices(rows.size());
    std::size_t next = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto left = static_cast<std::int64_t>(entries.size() - next);
        const bool fits = rows[k] >= 0 && columns[k] >= 0 && (rows[k] == 0 || columns[k] <= left / rows[k]);
        if (!fits) refuse_lengths(file, name);
        const auto size = static_cast<std::size_t>(rows[k] * columns[k]);
        matrices[k] = Eigen::Map<const M>(entries.data() + next, rows[k], columns[k]);
        next += size;
    }
    return matrices;
}

template <class R>
void write_rows(Hdf5Writer& file, const std::string& path, const Places<R>& rows) {
    const R example{};
    for_each_field(example, [&](const auto& entry, const auto& member) {
        Places<std::remove_cvref_t<decltype(member)>> column;
        column.reserve(rows.size());
        for (const R* row : rows) column.push_back(&(row->*(entry.member)));
        write_places(file, path_of(path, entry), column, entry.storage);
    });
}

template <class T>
void write_places(Hdf5Writer& file, const std::string& name, const Places<T>& values, Storage storage) {
    if constexpr (Scalar<T>) {
        std::vector<Kept<T>> numbers;
        numbers.reserve(values.size());
        for (const T* value : values) numbers.push_back(kept(*value));
        file.write(name, numbers, {}, storage == Storage::compressed);
    } else if constexpr (std::is_same_v<T, std::string>) {
        std::vector<std::string> texts;
        for (const std::string* text : values) texts.push_back(*text);
        file.write_texts(name, texts);
    } else if constexpr (kinds::is_array<T>) {
        write_elements(file, name, values, {values.size(), std::tuple_size_v<T>}, storage);
    } else if constexpr (kinds::is_vector<T> || kinds::is_optional<T>) {
        file.write(name + "/count", counts_of(values));
        write_elements(file, name + "/value", values, {}, storage);
    } else if constexpr (kinds::is_pair<T>) {
        Places<typename T::first_type> first;
        Places<typename T::second_type> second;
        for (const T* value : values) {
            first.push_back(&value->first);
            second.push_back(&value->second);
        }
        write_places(file, name + "/first", first, storage);
        write_places(file, name + "/second", second, storage);
    } else if constexpr (DenseMatrix<T>) {
        write_matrices(file, name, values, storage);
    } else {
        static_assert(Record<T>, "neither a record nor a kind of value that records are made of");
        write_rows(file, name, values);
    }
}

template <class R>
std::vector<R> read_rows(const Hdf5Reader& file, const std::string& path) {
    std::vector<R> rows;
    bool is_first = true;
    R example{};
    for_each_field(example, [&](const auto& entry, const auto& member) {
        auto column = read_column<std::remove_cvref_t<decltype(member)>>(file, path_of(path, entry));
        if (std::exchange(is_first, false)) rows.resize(column.size());
        if (column.size() != rows.size()) refuse_lengths(file, path);
        for (std::size_t k = 0; k < rows.size(); ++k) rows[k].*(entry.member) = std::move(column[k]);
    });
    return rows;
}

}  // namespace record_file

/// Writes one row for each of `values`, which are records or anything that a field may be.
template <class T>
void write_column(Hdf5Writer& file, const std::string& name, const std::vector<T>& values,
                  Storage storage = Storage::plain) {
    if constexpr (Scalar<T>) {
        record_file::write_scalars<T>(file, name, values, {}, storage);
    } else {
        record_file::Places<T> places;
        places.reserve(values.size());
        for (const T& value : values) places.push_back(&value);
        record_file::write_places(file, name, places, storage);
    }
}

/// Reads what write_column has written. Throws Error(input) where it is not there or its parts do not fit
/// together.
template <class T>
std::vector<T> read_column(const Hdf5Reader& file, const std::string& name) {
    if constexpr (Scalar<T>) {
        return record_file::read_scalars<T>(file, name);
    } else if constexpr (std::is_same_v<T, std::string>) {
        return file.read_texts(name);
    } else if constexpr (kinds::is_array<T>) {
        const auto flat = read_column<typename T::value_type>(file, name);
        std::vector<T> arrays(flat.size() / std::tuple_size_v<T>);
        for (std::size_t k = 0; k < arrays.size() * std::tuple_size_v<T>; ++k)
            arrays[k / std::tuple_size_v<T>][k % std::tuple_size_v<T>] = flat[k];
        return arrays;
    } else if constexpr (kinds::is_vector<T> || kinds::is_optional<T>) {
        return record_file::parted<T>(file, name);
    } else if constexpr (kinds::is_pair<T>) {
        auto first = read_column<typename T::first_type>(file, name + "/first");
        auto second = read_column<typename T::second_type>(file, name + "/second");
        if (first.size() != second.size()) record_file::refuse_lengths(file, name);
        std::vector<T> pairs;
        for (std::size_t k = 0; k < first.size(); ++k)
            pairs.emplace_back(std::move(first[k]), std::move(second[k]));
        return pairs;
    } else if constexpr (DenseMatrix<T>) {
        return record_file::read_matrices<T>(file, name);
    } else {
        static_assert(Record<T>, "neither a record nor a kind of value that records are made of");
        return record_file::read_rows<T>(file, name);
    }
}

/// Writes one record with its fields under `path`; "" is the root.
template <Record R>
void write_record(Hdf5Writer& file, const std::string& path, const R& record) {
    for_each_field(record, [&](const auto& entry, const auto& member) {
        using T = std::remove_cvref_t<decltype(member)>;
        const std::string name = record_file::path_of(path, entry);
        if constexpr (std::is_floating_point_v<T>) {
            file.attribute(name, static_cast<double>(member));
        } else if constexpr (Scalar<T>) {
            file.attribute(name, static_cast<std::int64_t>(member));
        } else if constexpr (std::is_same_v<T, std::string>) {
            file.attribute(name, member);
        } else if constexpr (kinds::is_vector<T>) {
            write_column(file, name, member, entry.storage);
        } else if constexpr (DenseMatrix<T>) {
            const std::span<const typename T::Scalar> entries(member.data(),
                                                              static_cast<std::size_t>(member.size()));
            record_file::write_scalars<typename T::Scalar>(
                file, name, entries,
                {static_cast<std::uint64_t>(member.cols()), static_cast<std::uint64_t>(member.rows())},
                entry.storage);
        } else if constexpr (Record<T>) {
            write_record(file, name, member);
        } else {
            record_file::write_places(file, name, record_file::Places<T>{&member}, entry.storage);
        }
    });
}

/// The attribute of the root that holds a number, a truth value or an enumerator. Throws Error(input) where
/// it is not there or holds what is no value of T.
template <Scalar T>
T read_scalar(const Hdf5Reader& file, const std::string& name) {
    if constexpr (std::is_floating_point_v<T>) {
        return record_file::value_of<T>(file, name, file.number(name));
    } else {
        return record_file::value_of<T>(file, name, file.integer(name));
    }
}

/// Reads what write_record has written. Throws Error(input) where a field is not there, or holds what is no
/// value of its type.
template <Record R>
void read_record(const Hdf5Reader& file, const std::string& path, R& record) {
    for_each_field(record, [&](const auto& entry, auto& member) {
        using T = std::remove_cvref_t<decltype(member)>;
        const std::string name = record_file::path_of(path, entry);
        if constexpr (Scalar<T>) {
            member = read_scalar<T>(file, name);
        } else if constexpr (std::is_same_v<T, std::string>) {
            member = file.text(name);
        } else if constexpr (kinds::is_vector<T>) {
            member = read_column<typename T::value_type>(file, name);
        } else if constexpr (DenseMatrix<T>) {
            const Hdf5Shape extent = file.shape(name);
            const auto entries = record_file::read_scalars<typename T::Scalar>(file, name);
            if (extent.size() != 2) record_file::refuse_lengths(file, name);
            const auto rows = static_cast<Eigen::Index>(extent[1]);
            const auto columns = static_cast<Eigen::Index>(extent[0]);
            if ((T::RowsAtCompileTime != Eigen::Dynamic && rows != T::RowsAtCompileTime) ||
                (T::ColsAtCompileTime != Eigen::Dynamic && columns != T::ColsAtCompileTime))
                record_file::refuse_lengths(file, name);
            member = Eigen::Map<const T>(entries.data(), rows, columns);
        } else if constexpr (Record<T>) {
            read_record(file, name, member);
        } else {
            auto column = read_column<T>(file, name);
            if (column.size() != 1) record_file::refuse_lengths(file, name);
            member = std::move(column.front());
        }
    });
}

}  // namespace coseg
