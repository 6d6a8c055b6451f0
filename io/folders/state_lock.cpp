#include "io/folders/state_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <utility>

namespace coseg {

namespace {

std::string host_name() {
    std::array<char, 256> name{};
    ::gethostname(name.data(), name.size() - 1);
    return name.data();
}

std::string now_as_text() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text.data();
}

/// "" if there is none.
std::string read_record(int descriptor) {
    std::array<char, 512> text{};
    const ssize_t count = ::pread(descriptor, text.data(), text.size() - 1, 0);
    const std::string record(text.data(), static_cast<std::size_t>(count > 0 ? count : 0));
    return record.substr(0, record.find('\n'));
}

std::string host_of(const std::string& record) {
    const std::string mark = "host ";
    if (!record.starts_with(mark)) return "";
    return record.substr(mark.size(), record.find(',') - mark.size());
}

timespec changed_at(int descriptor) {
    struct stat status {};
    ::fstat(descriptor, &status);
    return status.st_mtim;
}

std::string folder_of(const std::string& file) { return std::filesystem::path(file).parent_path().string(); }

}  // namespace

LockHeld::LockHeld(const std::string& folder, std::string record)
    : Error(ExitCode::output, folder + ": the state folder is in use by another " +
                                  (record.empty() ? std::string("coseg") : "run (" + record + ")") +
                                  "; wait until it has ended, or name another --state"),
      holder(std::move(record)) {}

LockUnwritable::LockUnwritable(const std::string& folder, std::string reason)
    : Error(ExitCode::output, folder + ": the state folder cannot be written (" + reason +
                                  "); free some space or name another --state"),
      cause(std::move(reason)) {}

StateLock::StateLock(const std::string& file, LockMode mode, LockTiming timing)
    : file_(file), timing_(timing) {
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor_ < 0) throw LockUnwritable(folder_of(file), std::strerror(errno));
    try {
        acquire(mode);
        if (mode == LockMode::exclusive) write_record();
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
    if (mode == LockMode::exclusive) heart_ = std::thread([this] { beat(); });
}

StateLock::~StateLock() {
    if (heart_.joinable()) {
        {
            const std::lock_guard<std::mutex> lock(mutex_);
            is_ending_ = true;
        }
        ended_.notify_all();
        heart_.join();
        if (::ftruncate(descriptor_, 0) != 0) errno = 0;  // the record then stays until it is taken over
    }
    ::close(descriptor_);
}

void StateLock::acquire(LockMode mode) {
    const int kind = mode == LockMode::exclusive ? LOCK_EX : LOCK_SH;
    if (::flock(descriptor_, kind | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) throw LockHeld(folder_of(file_), read_record(descriptor_));
        // A file system without locks: the record and its heartbeat are all there is.
        const std::string record = read_record(descriptor_);
        if (!record.empty()) wait_for_sign_of_life(record);
        return;
    }
    const std::string record = read_record(descriptor_);
    if (!record.empty() && host_of(record) != host_name()) wait_for_sign_of_life(record);
}

/// The clocks of hosts differ. A change of the file's time therefore counts, not its age.
void StateLock::wait_for_sign_of_life(const std::string& holder) {
    const timespec before = changed_at(descriptor_);
    const auto end = std::chrono::steady_clock::now() + timing_.patience;
    while (std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(timing_.heartbeat / 10);
        const timespec now = changed_at(descriptor_);
        if (now.tv_sec != before.tv_sec || now.tv_nsec != before.tv_nsec)
            throw LockHeld(folder_of(file_), holder);
    }
}

void StateLock::write_record() {
    const std::string record =
        "host " + host_name() + ", process " + std::to_string(::getpid()) + ", since " + now_as_text() + "\n";
    const bool written =
        ::ftruncate(descriptor_, 0) == 0 &&
        ::pwrite(descriptor_, record.data(), record.size(), 0) == static_cast<ssize_t>(record.size());
    if (!written) throw LockUnwritable(folder_of(file_), std::strerror(errno));
}

void StateLock::beat() {
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, nullptr);  // signals are for the thread that works
    std::unique_lock<std::mutex> lock(mutex_);
    while (!ended_.wait_for(lock, timing_.heartbeat, [this] { return is_ending_; })) {
        ::futimens(descriptor_, nullptr);
    }
}

}  // namespace coseg
