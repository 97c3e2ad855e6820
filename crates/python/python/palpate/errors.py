"""What palpate raises."""


class PalpateError(Exception):
    """Something went wrong that no other input would mend (the command ends with status 1)."""


class InputError(PalpateError, ValueError):
    """What was given has to be mended; the message says how (the command ends with status 2)."""
