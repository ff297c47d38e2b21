"""Reads the results of Solidus and draws them: numpy and matplotlib only."""
