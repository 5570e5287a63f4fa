"""How effective fractions look: the curve over shares, the map, the spread of the live load."""
