"""Validation: every part of the model of the air beside something that knows the answer."""
