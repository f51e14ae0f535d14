"""What has changed since a healthy part of a record: one table of tests, a row for each kind of change and channel."""
