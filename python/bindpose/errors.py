"""Python exceptions and warnings for the statuses of filters."""

from __future__ import annotations

from typing import Any


class BindposeError(RuntimeError):
    """A filter failed; the message is that of the filter.

    Attributes
    ----------
    status : str
        "invalid_input", "canceled", "unavailable" or "internal_error".
    report : dict
        The filter's measurements until the failure.
    """

    status = "internal_error"

    def __init__(self, message: str, report: dict[str, Any] | None = None) -> None:
        super().__init__(message)
        self.report = report or {}


class InvalidInput(BindposeError, ValueError):
    """The data cannot be used; the message names the first cause."""

    status = "invalid_input"


class Canceled(BindposeError):
    """The progress callback canceled the filter."""

    status = "canceled"


class Unavailable(BindposeError):
    """An optional part is missing; the message names the package to install."""

    status = "unavailable"


class BindposeWarning(UserWarning):
    """A warning about a result that is usable."""


class NotConvergedWarning(BindposeWarning):
    """There is a result, but its residuals are above the tolerance; the report contains them."""
