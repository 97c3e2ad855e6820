"""What palpate raises."""


class PalpateError(Exception):
    """Something went wrong that no other input avoids (the command ends with status 1)."""


class InputError(PalpateError, ValueError):
    """What was given is invalid; the message says how (the command ends with status 2)."""
