"""Tables of answers and results."""

from ._view import Shown, View, with_ends


class Table(Shown):
    """Columns of one length or shape: `table["name"]` is a read-only NumPy array, or a list of texts. A number with an
    interval has the columns NAME, NAME_lower and NAME_upper.

    attributes  what holds of the whole: a dictionary
    units       the unit of each column; "": none, or that in its name
    """

    def __init__(self, core):
        self.attributes, columns = core
        self.units = {name: unit for name, (unit, _) in columns.items()}
        self._columns = {name: values for name, (_, values) in columns.items()}

    def __getitem__(self, column):
        return self._columns[column]

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    def keys(self):
        """Names of the columns."""
        return self._columns.keys()

    def to_pandas(self):
        """A pandas.DataFrame of the columns that are lists; `attrs["units"]`: the unit of each column."""
        import pandas

        frame = pandas.DataFrame({name: values for name, values in self._columns.items()
                                  if getattr(values, "ndim", 1) == 1})
        frame.attrs["units"] = {name: self.units[name] for name in frame}
        return frame

    def _view(self):
        shown = View(f"Table of {len(self)} columns")
        texts = {name: value for name, value in self.attributes.items() if "\n" in str(value)}
        shown.facts((name, value) for name, value in self.attributes.items() if name not in texts)
        one = {name: values for name, values in self._columns.items() if getattr(values, "ndim", 1) == 1}
        ends = {name + end for name in one for end in ("_lower", "_upper") if f"{name}_lower" in one}
        of_length = {}
        for name in one:
            if name not in ends:
                of_length.setdefault(len(one[name]), []).append(name)
        for names in of_length.values():
            same = [name for name in one if len(one[name]) == len(one[names[0]])]
            rows = [dict(zip(same, row)) for row in zip(*(one[name] for name in same))]
            shown.table([f"{name} [{self.units[name]}]" if self.units[name] else name for name in names],
                        [[with_ends(row, name) if f"{name}_lower" in ends else row[name] for name in names] for row in rows])
        for name, text in texts.items():
            shown.more(name, text)
        others = [f"{name} {values.shape}" for name, values in self._columns.items() if name not in one]
        return shown.note("Not shown: " + ", ".join(others)) if others else shown

    def __repr__(self):
        return f"<Table: {', '.join(self)}>"
