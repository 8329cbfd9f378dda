"""What a filter's status becomes in Python."""


class BindposeError(RuntimeError):
    """A filter could not do its work; the text is the filter's one sentence.

    Attributes
    ----------
    status : str
        "invalid_input", "cancelled", "unavailable" or "internal_error".
    report : dict
        What the filter had measured until then.
    """

    status = "internal_error"

    def __init__(self, message, report=None):
        super().__init__(message)
        self.report = report or {}


class InvalidInput(BindposeError, ValueError):
    """The data cannot be used; the text names the first offender."""

    status = "invalid_input"


class Cancelled(BindposeError):
    """Stopped by the progress callback."""

    status = "cancelled"


class Unavailable(BindposeError):
    """An optional part is missing; the text names what to install."""

    status = "unavailable"


class BindposeWarning(UserWarning):
    """Something that the user should know about a result that is good otherwise."""


class NotConvergedWarning(BindposeWarning):
    """The result is there, but its residuals are above the tolerance; the report has them."""
