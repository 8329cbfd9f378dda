"""Replacement of PyVista's reader registry. A reader raises LocalFileRequiredError to make PyVista download a remote
file.
"""


class LocalFileRequiredError(Exception):
    pass


def has_scheme(value):
    """Report whether an address begins with a scheme, such as https."""
    return 0 < value.find("://") < value.find("/")
