"""Runs filters and turns their status into exceptions, warnings and a report."""

from __future__ import annotations

import contextlib
import json
import signal
import sys
import threading
import warnings as python_warnings
from typing import Any

from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from .errors import BindposeError, BindposeWarning, Canceled, InvalidInput, NotConvergedWarning, Unavailable
from .meshes import remember_run, run_of
from .parameter_types import Progress

errors_by_status = {error.status: error for error in (InvalidInput, Canceled, Unavailable, BindposeError)}


def _caller_level():
    """Return the `stacklevel` that the calling function must pass to warnings.warn(), so that the warning names the
    line outside of this package."""
    frame, level = sys._getframe(1), 1
    while frame.f_back and frame.f_globals.get("__name__", "").startswith("bindpose."):
        frame, level = frame.f_back, level + 1
    return level


@contextlib.contextmanager
def _deferred_interrupt():
    """Turn Ctrl-C into a flag, because VTK would end the process on an exception in an observer.

    Yield a list that is empty until Ctrl-C is pressed.
    """
    pressed = []
    main = threading.current_thread() is threading.main_thread()
    if not main or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield pressed
        return
    signal.signal(signal.SIGINT, lambda *_: pressed.append(True))
    try:
        yield pressed
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        if pressed:
            raise KeyboardInterrupt


class ProgressBar:
    """A callback for progress that draws a bar on the standard error, and calls another callback.

    Parameters
    ----------
    progress : callable, optional
        Another callback, called with the same arguments as this object. The object returns the result of this callback.
    """

    _WIDTH = 30  # characters of the bar

    def __init__(self, progress: Progress = None) -> None:
        self._progress = progress
        self._line = ""

    def __call__(self, fraction: float, phase: str) -> object:
        done = int(fraction * self._WIDTH)
        line = f"[{'#' * done}{'-' * (self._WIDTH - done)}] {int(100 * fraction):3} % {phase}"
        if line != self._line and sys.stderr:
            sys.stderr.write("\r" + line.ljust(len(self._line)))
            sys.stderr.flush()
            self._line = line
        return self._progress(fraction, phase) if self._progress else None

    def close(self) -> None:
        """Delete the bar."""
        if self._line:
            sys.stderr.write("\r" + " " * len(self._line) + "\r")
            sys.stderr.flush()
            self._line = ""


@contextlib.contextmanager
def interruptible(algorithm, progress=None):
    """Cancel an algorithm when Ctrl-C is pressed, and pass its progress to a callback, during a `with` block.

    An exception of the callback also cancels the algorithm. It is raised at the end of the block.
    """
    failed = []
    with _deferred_interrupt() as pressed:

        def on_progress(caller, _event):
            if failed or caller.GetAbortExecute():
                return
            try:
                phase = caller.GetProgressText() or ""
                if pressed or (progress and progress(caller.GetProgress(), phase) is False):
                    caller.SetAbortExecute(1)
            except Exception as error:  # pylint: disable=broad-except  raised again below
                failed.append(error)
                caller.SetAbortExecute(1)

        observers = [algorithm.AddObserver("ProgressEvent", on_progress)]
        # Observers that do nothing: VTK prints an error or a warning only if the algorithm has no observer of the
        # event. run() raises exceptions and issues warnings from the status of the algorithm instead.
        for event in ("ErrorEvent", "WarningEvent"):
            observers.append(algorithm.AddObserver(event, lambda *_: None))
        try:
            yield
        finally:
            for observer in observers:
                algorithm.RemoveObserver(observer)
            if isinstance(progress, ProgressBar):
                progress.close()
    if failed:
        raise failed[0]


def run(algorithm: vtkAlgorithm, progress: Progress = None) -> dict[str, Any]:
    """Update a filter of Bindpose, and turn its status into exceptions and warnings.

    Parameters
    ----------
    algorithm : vtkBindposeAlgorithm
        Any of the package's filters; a writer writes its file.
    progress : callable, optional
        Called with (fraction in [0, 1], name of the phase). Returning False cancels.

    Returns
    -------
    dict
        The filter's report.

    Raises
    ------
    InvalidInput, Canceled, Unavailable, BindposeError
        The exception that corresponds to the filter's status, with the filter's message.
    KeyboardInterrupt
        After Ctrl-C, which cancels the filter.

    Warns
    -----
    NotConvergedWarning
        The result is kept.
    BindposeWarning
        One per warning of the filter.

    Examples
    --------
    >>> spread = bindpose.vtkFarthestPointHandles()
    >>> bindpose.run(spread)
    Traceback (most recent call last):
        ...
    bindpose.errors.InvalidInput: there is no input at port 0
    """
    for port in range(algorithm.GetNumberOfInputPorts()):
        is_optional = algorithm.GetInputPortInformation(port).Has(vtkAlgorithm.INPUT_IS_OPTIONAL())
        if not is_optional and not algorithm.GetNumberOfInputConnections(port):
            raise InvalidInput(f"there is no input at port {port}")
    with interruptible(algorithm, progress):
        algorithm.Write() if hasattr(algorithm, "Write") else algorithm.Update()
    result = json.loads(algorithm.GetReportJSON())
    for port in range(algorithm.GetNumberOfOutputPorts()):
        remember_run(algorithm.GetOutputDataObject(port), result)
    check_status(algorithm, result)
    return result


def check_status(algorithm, report):
    """Raise the exception of a filter's status, and issue its warnings.

    Parameters
    ----------
    algorithm : vtkBindposeAlgorithm
    report : dict
        The filter's report.
    """
    status = algorithm.GetStatusAsString()
    if status not in ("ok", "not_converged"):
        raise errors_by_status[status](algorithm.GetStatusMessage(), report)
    for sentence in report.get("warnings", []):
        warn(sentence, BindposeWarning)
    if status == "not_converged":
        warn(algorithm.GetStatusMessage(), NotConvergedWarning)


def warn(sentence, category):
    """Issue a warning that names the line outside of this package from which the package was called."""
    python_warnings.warn(sentence, category, stacklevel=_caller_level())


def report(result: Any) -> dict[str, Any]:
    """Return the numbers of a result: certificates, counts, seconds per phase.

    Parameters
    ----------
    result : vtkDataObject, vtkBindposeAlgorithm, Array or Tets
        The result of a function of this package, a filter, its output, or a file that was read.

    Returns
    -------
    dict
        Keys with dots become nested dicts (``report(w)["seconds"]["solve"]``); empty for data without a report. The
        reports of files, and of outputs of filters that you updated yourself, contain no seconds and no memory, so that
        equal results give equal files. The report of the filter itself contains both.

    Examples
    --------
    >>> tetrahedron = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    ...                [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    >>> bindpose.report(bindpose.winding_number(tetrahedron, 8))["status"]
    'ok'
    """
    if hasattr(result, "report"):
        return result.report
    if hasattr(result, "GetReportJSON"):
        return json.loads(result.GetReportJSON())
    from .BindposeFilters import vtkBindposeAlgorithm  # imported on first use, after VTK

    own = json.loads(vtkBindposeAlgorithm.GetReportJSONOf(result))
    whole = run_of(result)
    return whole if own and _is_part(own, whole) else own


def _is_part(own, whole):
    """Report whether all entries of the report `own` are in the report `whole` with equal values.

    If not, the filter was updated again since `own` was written.
    """
    if isinstance(own, dict):
        return isinstance(whole, dict) and all(key in whole and _is_part(own[key], whole[key]) for key in own)
    if isinstance(own, list):
        return isinstance(whole, list) and len(own) == len(whole) and all(map(_is_part, own, whole))
    return own == whole
