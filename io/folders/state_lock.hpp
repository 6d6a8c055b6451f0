#pragma once
// One run at a time on a state folder.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace coseg {

enum class LockMode {
    shared,     ///< only adds files that no other process changes: any number of these at once
    exclusive,  ///< one alone
};

/// What a lock knows of time; tests make it short.
struct LockTiming {
    std::chrono::milliseconds heartbeat{
        5000};  ///< the holder's sign of life, a changed time of the lock file
    std::chrono::milliseconds patience{
        16000};  ///< without a sign for so long a holder on another host counts as dead
};

/// Holds FILE locked while it lives. The operating system ends the lock with the process, however that ends. Where file
/// systems lock for one host only, the record in FILE (host, process, time) and its heartbeat tell a holder on another
/// host; that of a dead one is taken over after `patience`. Not collective: one rank holds it for all.
class StateLock {
  public:
    /// Throws Error(output): naming the holder if there is one, or the cause if the file cannot be made.
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
    LockMode mode_;
    int descriptor_ = -1;
    std::mutex mutex_;
    std::condition_variable ended_;
    bool is_ending_ = false;
    std::thread heart_;
};

}  // namespace coseg
