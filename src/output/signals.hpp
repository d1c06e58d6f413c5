#pragma once
#include <csignal>

namespace carom {

/// While it lives, a write that cannot succeed (nobody reads the pipe, file size limit) returns an error instead of
/// killing the process. Only this thread is touched, so a library may do it.
class QuietWrites {
  public:
    QuietWrites() {
        sigemptyset(&signals_);
        sigaddset(&signals_, SIGPIPE);
        sigaddset(&signals_, SIGXFSZ);
        sigset_t pending;
        sigpending(&pending);
        pipe_was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    }
    QuietWrites(const QuietWrites&) = delete;
    QuietWrites& operator=(const QuietWrites&) = delete;
    ~QuietWrites() {
        sigset_t pending;
        sigpending(&pending);
        for (int raised : {SIGPIPE, SIGXFSZ}) {
            if (raised == SIGPIPE && pipe_was_pending_) continue;
            if (sigismember(&pending, raised) == 1) consume(raised);
        }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }

  private:
    static void consume(int signal) {
        sigset_t one;
        sigemptyset(&one);
        sigaddset(&one, signal);
        int got;
        sigwait(&one, &got);
    }
    sigset_t signals_{}, before_{};
    bool pipe_was_pending_ = false;
};

}  // namespace carom
