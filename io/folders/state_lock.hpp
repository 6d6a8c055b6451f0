#pragma once
// Lets one run at a time use a state folder.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "src/base/error.hpp"

namespace coseg {

enum class LockMode {
    shared,     ///< for processes that only add files which no other one changes; any number at once
    exclusive,  ///< for one process alone
};

/// The times of a lock; tests make them short.
struct LockTiming {
    std::chrono::milliseconds heartbeat{
        5000};  ///< The holder shows that it lives by changing the time of the lock file at this interval.
    std::chrono::milliseconds patience{
        16000};  ///< A holder on another host counts as dead after this time without a sign.
};

/// Thrown where another process has the lock. Its sentence is that of a state folder.
struct LockHeld : Error {
    LockHeld(const std::string& folder, std::string record);
    std::string holder;  ///< "host NAME, process NUMBER, since TIME", or empty where that is not known
};

/// Thrown where the lock's file cannot be made or written. Its sentence is that of a state folder.
struct LockUnwritable : Error {
    LockUnwritable(const std::string& folder, std::string reason);
    std::string cause;  ///< in the system's words
};

/// Holds FILE locked during its lifetime. The operating system ends the lock with the process, however that
/// ends. Some file systems lock for one host only. There, the record in FILE (host, process, time) and its
/// heartbeat reveal a holder on another host. The lock of a dead holder is taken over after `patience`. Not
/// collective: one rank holds the lock for all.
class StateLock {
  public:
    /// Takes the lock. Throws LockHeld or LockUnwritable, whose code is that of output.
    StateLock(const std::string& file, LockMode mode, LockTiming timing = {});
    ~StateLock();
    StateLock(const StateLock&) = delete;
    StateLock& operator=(const StateLock&) = delete;

  private:
    void acquire(LockMode mode);
    void wait_for_sign_of_life(const std::string& holder);
    void write_record();
    void beat();

    std::string file_;
    LockTiming timing_;
    int descriptor_ = -1;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool is_ending_ = false;
    std::thread heart_;
};

}  // namespace coseg
