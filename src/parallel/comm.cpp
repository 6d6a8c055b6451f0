#include "src/parallel/comm.hpp"

#include <limits>
#include <utility>

namespace coseg {

Comm::Comm(MPI_Comm parent) {
    MPI_Comm_dup(parent, &comm_);
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
}

Comm::Comm(MPI_Comm owned, Adopt) : comm_(owned) {
    MPI_Comm_rank(comm_, &rank_);
    MPI_Comm_size(comm_, &size_);
}

Comm::~Comm() {
    if (comm_ != MPI_COMM_NULL) {
        int finalized = 0;
        MPI_Finalized(&finalized);
        // A rank that unwinds alone must not enter a collective call: the others would wait for it.
        if (finalized == 0 && std::uncaught_exceptions() == 0) MPI_Comm_free(&comm_);
    }
}

Comm::Comm(Comm&& other) noexcept
    : comm_(std::exchange(other.comm_, MPI_COMM_NULL)), rank_(other.rank_), size_(other.size_) {}

Comm& Comm::operator=(Comm&& other) noexcept {
    std::swap(comm_, other.comm_);
    std::swap(rank_, other.rank_);
    std::swap(size_, other.size_);
    return *this;
}

Comm Comm::split(int colour) const {
    MPI_Comm part = MPI_COMM_NULL;
    MPI_Comm_split(comm_, colour, rank_, &part);
    return {part, Adopt{}};
}

namespace {

struct Failure {
    int code = 0;
    std::string sentence;
};

std::optional<Failure> run_and_catch(const std::function<void()>& step) {
    try {
        step();
    } catch (const Error& error) {
        return Failure{static_cast<int>(error.code()), error.what()};
    } catch (const std::bad_alloc&) {
        return Failure{static_cast<int>(ExitCode::internal), "out of memory; use more nodes or fewer shapes"};
    } catch (const std::exception& error) {
        return Failure{static_cast<int>(ExitCode::internal), error.what()};
    }
    return std::nullopt;
}

template <class T>
std::vector<T> all_gather_of(const Comm& comm, std::span<const T> local, MPI_Datatype type) {
    if (local.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        throw Error(ExitCode::internal, "a rank gathers more than 2^31 values at once");
    }
    const int count = static_cast<int>(local.size());
    std::vector<int> counts(static_cast<std::size_t>(comm.size()));
    MPI_Allgather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, comm.raw());
    std::vector<int> offsets(counts.size());
    std::int64_t total = 0;
    for (std::size_t r = 0; r < counts.size(); ++r) {
        offsets[r] = static_cast<int>(total);
        total += counts[r];
        if (total > std::numeric_limits<int>::max()) {
            throw AgreedError(ExitCode::internal, "more than 2^31 values gathered at once; use fewer shapes");
        }
    }
    std::vector<T> all(static_cast<std::size_t>(total));
    MPI_Allgatherv(local.data(), count, type, all.data(), counts.data(), offsets.data(), type, comm.raw());
    return all;
}

}  // namespace

void agree(const Comm& comm, const std::function<void()>& step) {
    const std::optional<Failure> failure = run_and_catch(step);
    const int mine = failure ? comm.rank() : comm.size();
    int first = comm.size();
    MPI_Allreduce(&mine, &first, 1, MPI_INT, MPI_MIN, comm.raw());
    if (first == comm.size()) return;
    int header[2] = {0, 0};
    std::string sentence;
    if (comm.rank() == first) {
        sentence = failure->sentence;
        header[0] = failure->code;
        header[1] = static_cast<int>(sentence.size());
    }
    MPI_Bcast(header, 2, MPI_INT, first, comm.raw());
    sentence.resize(static_cast<std::size_t>(header[1]));
    MPI_Bcast(sentence.data(), header[1], MPI_CHAR, first, comm.raw());
    throw AgreedError(static_cast<ExitCode>(header[0]), sentence);
}

std::vector<double> all_gather(const Comm& comm, std::span<const double> local) {
    return all_gather_of<double>(comm, local, MPI_DOUBLE);
}

std::vector<int> all_gather(const Comm& comm, std::span<const int> local) {
    return all_gather_of<int>(comm, local, MPI_INT);
}

std::vector<std::int64_t> all_gather(const Comm& comm, std::span<const std::int64_t> local) {
    return all_gather_of<std::int64_t>(comm, local, MPI_INT64_T);
}

namespace {

/// One buffer for several texts, each ended by a zero byte, which no path or sentence contains.
std::string joined(const std::vector<std::string>& texts) {
    std::string buffer;
    for (const std::string& text : texts) {
        buffer += text;
        buffer += '\0';
    }
    return buffer;
}

std::vector<std::string> parted(const std::string& buffer) {
    std::vector<std::string> texts;
    for (std::size_t begin = 0; begin < buffer.size();) {
        const std::size_t end = buffer.find('\0', begin);
        texts.push_back(buffer.substr(begin, end - begin));
        begin = end + 1;
    }
    return texts;
}

}  // namespace

std::vector<std::string> all_gather_texts(const Comm& comm, const std::vector<std::string>& local) {
    const std::string mine = joined(local);
    const std::vector<char> all = all_gather_of<char>(comm, std::span<const char>(mine), MPI_CHAR);
    return parted(std::string(all.begin(), all.end()));
}

void broadcast_texts(const Comm& comm, std::vector<std::string>& texts) {
    std::string buffer = comm.is_root() ? joined(texts) : std::string();
    std::int64_t size = static_cast<std::int64_t>(buffer.size());
    MPI_Bcast(&size, 1, MPI_INT64_T, 0, comm.raw());
    buffer.resize(static_cast<std::size_t>(size));
    MPI_Bcast(buffer.data(), static_cast<int>(size), MPI_CHAR, 0, comm.raw());
    texts = parted(buffer);
}

double all_max(const Comm& comm, double local) {
    double result = 0.0;
    MPI_Allreduce(&local, &result, 1, MPI_DOUBLE, MPI_MAX, comm.raw());
    return result;
}

double all_min(const Comm& comm, double local) {
    double result = 0.0;
    MPI_Allreduce(&local, &result, 1, MPI_DOUBLE, MPI_MIN, comm.raw());
    return result;
}

std::int64_t all_sum(const Comm& comm, std::int64_t local) {
    std::int64_t result = 0;
    MPI_Allreduce(&local, &result, 1, MPI_INT64_T, MPI_SUM, comm.raw());
    return result;
}

}  // namespace coseg
