"""How records, scaled and matched suites, and pulses look."""
