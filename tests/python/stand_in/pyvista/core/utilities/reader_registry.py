"""The exception by which a reader asks PyVista to download a remote file."""


class LocalFileRequiredError(Exception):
    pass
