#ifndef bindpose_cli_interrupt_h
#define bindpose_cli_interrupt_h

class vtkAlgorithm;

namespace bindpose::cli
{

/// From now on SIGINT (Ctrl-C) and SIGTERM cancel instead of killing: the algorithm that runs is
/// aborted and later ones do not start. A second signal removes temporary files and ends the
/// program at once with exit code 4, for the one case that cannot be cancelled in between (a
/// factorisation). They are blocked in all threads from the start of the program; until this is
/// called they wait. Call once.
void catch_interrupts();

/// Signals kill again, as they do by default: for a window, which nobody waits for.
void release_interrupts();

/// A signal came.
bool interrupted();

/// Aborts the algorithm when a signal comes while this lives.
class AbortOnInterrupt
{
public:
  explicit AbortOnInterrupt(vtkAlgorithm* algorithm);
  ~AbortOnInterrupt();
  AbortOnInterrupt(const AbortOnInterrupt&) = delete;
  AbortOnInterrupt& operator=(const AbortOnInterrupt&) = delete;

private:
  vtkAlgorithm* outer_;
};

} // namespace bindpose::cli

#endif
