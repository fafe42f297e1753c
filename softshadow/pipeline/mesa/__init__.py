"""Accidents of one driver, imitated so that every bit agrees: what Mesa joins, cuts and leaves out."""
