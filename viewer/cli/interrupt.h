#ifndef bindpose_cli_interrupt_h
#define bindpose_cli_interrupt_h

class vtkAlgorithm;

namespace bindpose::cli
{

/// Let SIGINT (Ctrl-C) and SIGTERM cancel the work instead of ending the program: the running
/// algorithm is aborted, and later algorithms do not start. A second signal removes temporary files
/// and ends the program immediately with exit code 4, because a factorization cannot be canceled.
/// All threads block the signals from the start of the program, so a signal that arrives before
/// this call stays pending. Call this function once.
void catch_interrupts();

/// Let signals end the program again, as they do by default. Call this function when the window
/// opens, because a signal then has no work to cancel.
void release_interrupts();

/// Report whether a signal has arrived.
bool interrupted();

/// Aborts an algorithm if a signal arrives while this object exists.
class AbortOnInterrupt
{
public:
  explicit AbortOnInterrupt(vtkAlgorithm* algorithm);
  ~AbortOnInterrupt();
  AbortOnInterrupt(const AbortOnInterrupt&) = delete;
  AbortOnInterrupt& operator=(const AbortOnInterrupt&) = delete;

private:
  vtkAlgorithm* outer_algorithm_;
};

} // namespace bindpose::cli

#endif
