"""A model against a stream: innovations, tests of them at a stated rate of false alarms, and alarms."""
