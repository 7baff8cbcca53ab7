#include "cli/interrupt.h"

#include <csignal>
#include <mutex>
#include <thread>

#include <pthread.h>
#include <unistd.h>

#include "cli/exit_code.h"

namespace etalon::cli {
namespace {

// Held by whoever is writing files, and by the watcher from the signal to the end of the process.
std::recursive_mutex& writing() {
  static std::recursive_mutex* mutex = new std::recursive_mutex;  // outlives every static object
  return *mutex;
}

}  // namespace

void watch_for_interrupt() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);  // inherited by every later thread
  writing();
  std::thread([signals] {
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    writing().lock();
    _exit(kExitInterrupted);  // no destructors: other threads may be anywhere
  }).detach();
}

FinishWriting::FinishWriting() { writing().lock(); }
FinishWriting::~FinishWriting() { writing().unlock(); }

}  // namespace etalon::cli
