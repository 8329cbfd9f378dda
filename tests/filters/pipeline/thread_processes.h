#ifndef bindpose_tests_filters_thread_processes_h
#define bindpose_tests_filters_thread_processes_h

// Threads that act as the processes of VTK's parallel filters and exchange messages in memory.

#include "vtkAbstractArray.h"
#include "vtkCommunicator.h"
#include "vtkDummyController.h"
#include "vtkNew.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace bindpose::test
{

/// The messages between the threads.
class Mail
{
public:
  void send(int from, int to, int tag, std::string message)
  {
    const std::lock_guard<std::mutex> lock(this->mutex_);
    this->messages_[{ from, to, tag }].push_back(std::move(message));
    this->arrived_.notify_all();
  }
  /// Wait for a message. Return false if there is none after 20 seconds, so that no test hangs.
  bool receive(int from, int to, int tag, std::string& message)
  {
    std::unique_lock<std::mutex> lock(this->mutex_);
    std::deque<std::string>& queue = this->messages_[{ from, to, tag }];
    if (!this->arrived_.wait_for(
          lock, std::chrono::seconds(20), [&queue]() { return !queue.empty(); }))
    {
      return false;
    }
    message = std::move(queue.front());
    queue.pop_front();
    return true;
  }

private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  /// Queues of messages. The key is (sender, receiver, tag).
  std::map<std::array<int, 3>, std::deque<std::string>> messages_;
};

class ThreadCommunicator : public vtkCommunicator
{
public:
  static ThreadCommunicator* New()
  {
    auto* communicator = new ThreadCommunicator;
    communicator->InitializeObjectBase();
    return communicator;
  }
  vtkTypeMacro(ThreadCommunicator, vtkCommunicator);

  void initialize(std::shared_ptr<Mail> mail, int process, int processes)
  {
    this->mail_ = std::move(mail);
    this->LocalProcessId = process;
    this->NumberOfProcesses = processes;
  }

  int SendVoidArray(const void* data, vtkIdType length, int type, int remote, int tag) override
  {
    const auto size = static_cast<std::size_t>(length * vtkAbstractArray::GetDataTypeSize(type));
    this->mail_->send(
      this->LocalProcessId, remote, tag, std::string(static_cast<const char*>(data), size));
    return 1;
  }
  int ReceiveVoidArray(void* data, vtkIdType length, int type, int remote, int tag) override
  {
    const int value_size = vtkAbstractArray::GetDataTypeSize(type);
    std::string message;
    if (!this->mail_->receive(remote, this->LocalProcessId, tag, message) ||
      message.size() > static_cast<std::size_t>(length * value_size))
    {
      return 0;
    }
    std::memcpy(data, message.data(), message.size());
    this->Count = static_cast<vtkIdType>(message.size()) / value_size;
    return 1;
  }

private:
  std::shared_ptr<Mail> mail_;
};

/// Run a function in one thread per process, and wait until all threads have ended.
inline void run_processes(int processes,
  const std::function<void(int process, vtkMultiProcessController* controller)>& work)
{
  const auto mail = std::make_shared<Mail>();
  std::vector<std::thread> threads;
  for (int process = 0; process < processes; ++process)
  {
    threads.emplace_back(
      [&work, mail, process, processes]()
      {
        vtkNew<ThreadCommunicator> communicator;
        communicator->initialize(mail, process, processes);
        vtkNew<vtkDummyController> controller;
        controller->SetCommunicator(communicator);
        work(process, controller);
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

} // namespace bindpose::test

#endif
