"""How a risk-targeted share looks."""
