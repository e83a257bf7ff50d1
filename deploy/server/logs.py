"""Log lines of bounded length: a refused message of a megabyte is no log line of a megabyte."""

import logging

LONGEST_LINE = 2000


def shorten(text):
    """The text with its middle cut out where it is longer than a log line may be."""
    if len(text) <= LONGEST_LINE:
        return text
    half = LONGEST_LINE // 2
    return f"{text[:half]} ... {len(text) - 2 * half} characters cut ... {text[-half:]}"


class ShortRecord(logging.LogRecord):
    """A log record of bounded length."""

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        if self.exc_info and self.exc_info[0] is not None:
            self.exc_text = shorten(logging.Formatter().formatException(self.exc_info))

    def getMessage(self):
        return shorten(super().getMessage())


def install():
    """Bound every log record of this process."""
    logging.setLogRecordFactory(ShortRecord)
