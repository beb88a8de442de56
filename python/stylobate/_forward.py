"""What the classes pass on to the C++ objects behind them."""


def forwarded(name, doc):
    """The property `name` of `self._core`."""
    return property(lambda self: getattr(self._core, name), doc=doc)


def options(made, **values):
    """Options of a C++ function, by their names."""
    for name, value in values.items():
        setattr(made, name, value)
    return made
