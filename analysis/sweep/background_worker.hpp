#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>

namespace gnomon::analysis {

/// A thread that does pieces of work in order. It holds a limited number, which bounds their
/// memory, and starts with the first.
class BackgroundWorker {
public:
    /// @param most_pieces  That it holds, with the one in progress; >= 1.
    explicit BackgroundWorker(std::size_t most_pieces) : most_pieces_{most_pieces} {}
    BackgroundWorker(const BackgroundWorker&) = delete;
    BackgroundWorker& operator=(const BackgroundWorker&) = delete;
    ~BackgroundWorker()
    {
        {
            const std::lock_guard lock{mutex_};
            ends_ = true;
        }
        changed_.notify_all();
        if (thread_.joinable()) {
            thread_.join();
        }
    }

    /// Waits for room, and adds the piece. Rethrows the exception of an earlier piece; later pieces
    /// were dropped, and no more are accepted.
    void add(std::function<void()> piece)
    {
        std::unique_lock lock{mutex_};
        changed_.wait(
            lock, [&] { return waiting_.size() + (is_busy_ ? 1 : 0) < most_pieces_ || error_; });
        rethrow();
        if (!thread_.joinable()) {
            thread_ = std::thread{[this] { work(); }};
        }
        waiting_.push_back(std::move(piece));
        changed_.notify_all();
    }

    /// Waits until everything is done; throws as `add` does.
    void finish()
    {
        std::unique_lock lock{mutex_};
        changed_.wait(lock, [&] { return (waiting_.empty() && !is_busy_) || error_; });
        rethrow();
    }

private:
    void rethrow()
    {
        if (error_) {
            std::rethrow_exception(error_);
        }
    }

    void work()
    {
        std::unique_lock lock{mutex_};
        while (true) {
            changed_.wait(lock, [&] { return !waiting_.empty() || ends_; });
            if (waiting_.empty()) {
                return;
            }
            const std::function<void()> piece = std::move(waiting_.front());
            waiting_.pop_front();
            is_busy_ = true;
            changed_.notify_all();
            lock.unlock();
            std::exception_ptr error;
            try {
                piece();
            } catch (...) {
                error = std::current_exception();
            }
            lock.lock();
            is_busy_ = false;
            if (error) {
                error_ = error;
                waiting_.clear();
            }
            changed_.notify_all();
        }
    }

    std::size_t most_pieces_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    std::exception_ptr error_;
    bool is_busy_ = false;
    bool ends_ = false;
    std::thread thread_;
};

} // namespace gnomon::analysis
